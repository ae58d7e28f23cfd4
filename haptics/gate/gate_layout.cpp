#include "haptics/gate/gate_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>

#include "haptics/files/parameter_file.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::haptics {
namespace {

// Gear names "R", "1", "2", ... Neutral has no slot and is not in the list.
const std::vector<std::string>& gear_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{gear_name(kReverseGear)};
    for (int gear = 1; gear <= kMaxGateGear; ++gear) list.emplace_back(gear_name(gear));
    return list;
  }();
  return names;
}

int read_gear(const TomlTable& table, std::string_view key) {
  const std::string word = table.choice(key, gear_names());
  int gear = kReverseGear;
  while (word != gear_name(gear)) ++gear;
  return gear;
}

// Reads a label to be shown on knob and plate; empty if the key is absent.
std::string read_label(const TomlTable& table, std::string_view key) {
  if (!table.has(key)) return {};
  const std::string label = table.text(key);
  if (label.empty() || label.size() > kMaxLabel)
    table.fail(key, "must have 1 to " + std::to_string(kMaxLabel) + " bytes");
  return label;
}

// The gear of the place with this label or name.
int read_place(const TomlTable& table, std::string_view key, const GateLayout& layout) {
  std::vector<std::string> names;
  for (const PlaceLayout& place : layout.places)
    names.push_back(place.label.empty() ? gear_name(place.gear) : place.label);
  const std::string word = table.choice(key, names);
  return layout.places[static_cast<std::size_t>(std::find(names.begin(), names.end(), word) - names.begin())].gear;
}

// A lockout of a sequential gate may also bar the way from first to neutral.
int read_locked_gear(const TomlTable& table, const GateLayout& layout) {
  if (!layout.aisles.empty()) return read_place(table, "place", layout);
  if (layout.sequential_gears == 0) return read_gear(table, "gear");
  const std::vector<std::string> names{gear_name(kReverseGear), gear_name(kNeutralGear)};
  return table.choice("gear", names) == names.front() ? kReverseGear : kNeutralGear;
}

SlotLayout read_slot(const TomlTable& column, std::string_view key) {
  const std::string label = read_label(column, std::string(key) + "_label");
  if (!column.has(key)) return {};
  return {read_gear(column, key), column.line(key), label};
}

ColumnLayout read_column(const TomlTable& table) {
  ColumnLayout column;
  column.line = table.line();
  (void)table.number("position_mm", {-200.0, 200.0});  // is required
  read_parameters(table, column);
  column.forward = read_slot(table, "forward");
  column.back = read_slot(table, "back");
  if (table.has("junction")) {
    const bool closed = table.choice("junction", {"open", "closed"}) == "closed";
    column.junction = closed ? JunctionKind::closed : JunctionKind::open;
  }
  return column;
}

// Reads the columns in the order of the file. Exactly one column must be marked as neutral.
void read_columns(const TomlTable& root, GateLayout& layout) {
  const TomlTable* neutral = nullptr;
  const auto tables = root.tables("column");
  for (const TomlTable& table : tables) {
    layout.columns.push_back(read_column(table));
    if (table.flag_or("neutral", false)) {
      if (neutral != nullptr) {
        table.fail("neutral", "only one column can be neutral, but the column on line " +
                                  std::to_string(neutral->line("neutral")) + " already is");
      }
      neutral = &table;
      layout.neutral_column = static_cast<int>(layout.columns.size()) - 1;
    }
    table.reject_unknown_keys();
  }
  if (tables.empty()) root.fail("column", "is missing: write one [[column]] for every column of gears");
  if (neutral == nullptr) {
    tables.front().fail({}, "no column is neutral; write neutral = true in exactly one [[column]]");
  }
}

// A sequential gate has one column, whose slots are the strokes up and down.
void read_sequence(const TomlTable& root, GateLayout& layout) {
  const TomlTable table = root.table("sequential");
  if (root.has("column")) root.fail("column", "must be left out, because [sequential] makes the only column");
  const double gears = table.number("gears", {1.0, kMaxGear});
  if (gears != std::floor(gears)) table.fail("gears", "must be a whole number");
  layout.sequential_gears = static_cast<int>(gears);
  const bool pulls_up = table.choice("up", {"back", "forward"}) == "back";
  ColumnLayout column;
  column.line = table.line();
  column.forward = {pulls_up ? kPreviousGear : kNextGear, table.line("up"), {}};
  column.back = {pulls_up ? kNextGear : kPreviousGear, table.line("up"), {}};
  layout.columns.push_back(column);
  table.reject_unknown_keys();
}

void read_gate(const TomlTable& table, GateLayout& layout) {
  read_parameters(table, layout);
  layout.lines.gate = table.line();
  layout.lines.slot_length = table.line("slot_length_mm");
  table.reject_unknown_keys();
}

void read_feel(const TomlTable& table, GateLayout& layout) {
  read_parameters(table, layout.feel);
  layout.lines.feel = table.line();
  table.reject_unknown_keys();
}

LockoutKind read_kind(const TomlTable& table) {
  static constexpr std::array kKinds{LockoutKind::push_down,  LockoutKind::lift,       LockoutKind::speed,
                                     LockoutKind::after_gear, LockoutKind::only_after, LockoutKind::brake};
  std::vector<std::string> names;
  names.reserve(kKinds.size());
  for (const LockoutKind kind : kKinds) names.emplace_back(to_string(kind));
  const std::string word = table.choice("kind", names);
  return *std::find_if(kKinds.begin(), kKinds.end(), [&](LockoutKind kind) { return word == to_string(kind); });
}

// Reads the names of gears, separated by spaces.
std::uint32_t read_gear_set(const TomlTable& table, std::string_view key) {
  std::uint32_t set = 0;
  std::istringstream words(table.text(key));
  for (std::string word; words >> word;) {
    const auto& names = gear_names();
    if (std::find(names.begin(), names.end(), word) == names.end())
      table.fail(key, "\"" + word + "\" is no gear; write gears, separated by spaces");
    int gear = kReverseGear;
    while (word != gear_name(gear)) ++gear;
    set |= gear_bit(gear);
  }
  if (set == 0) table.fail(key, "names no gear");
  return set;
}

// Reads the speeds only for a speed lockout. In any other lockout they are therefore rejected as unknown keys instead
// of being ignored.
LockoutLayout read_lockout(const TomlTable& table, const GateLayout& layout) {
  LockoutLayout lockout;
  lockout.line = table.line();
  lockout.gear = read_locked_gear(table, layout);
  lockout.kind = read_kind(table);
  const bool depends_on_gear = lockout.kind == LockoutKind::after_gear || lockout.kind == LockoutKind::only_after;
  if (depends_on_gear && layout.sequential_gears > 0)
    table.fail("kind", "must be push_down, lift, speed or brake in a sequential gate");
  if (depends_on_gear && !layout.aisles.empty())
    table.fail("kind", "must be push_down, lift, speed or brake in a gate of aisles");
  if (!layout.aisles.empty()) lockout.is_leaving = table.flag_or("leaving", false);
  if (lockout.kind == LockoutKind::only_after) lockout.only_after = read_gear_set(table, "after");
  if (lockout.kind == LockoutKind::after_gear) lockout.after_gear = read_gear(table, "after");
  if (lockout.kind == LockoutKind::speed) read_parameters(table, lockout);
  table.reject_unknown_keys();
  return lockout;
}

// An H gate or a sequential gate.
void read_comb(const TomlTable& root, GateLayout& layout) {
  if (root.has("gate")) read_gate(root.table("gate"), layout);
  if (root.has("feel")) read_feel(root.table("feel"), layout);
  if (root.has("sequential"))
    read_sequence(root, layout);
  else
    read_columns(root, layout);
}

PlaceLayout read_place(const TomlTable& table, int index) {
  PlaceLayout place;
  place.line = table.line();
  for (const char* key : {"x_mm", "y_mm"}) (void)table.number(key, {-200.0, 200.0});  // both are required
  read_parameters(table, place);
  place.label = read_label(table, "label");
  if (table.flag_or("neutral", false)) return place;
  if (!table.has("gear") && place.label.empty()) table.fail({}, "a place needs a gear or a label, or neutral = true");
  place.gear = table.has("gear") ? read_gear(table, "gear") : kFirstPosition + index;
  return place;
}

// A mechanism of aisles and places. Its only common number is the force towards the neutral place.
void read_mechanism(const TomlTable& root, GateLayout& layout) {
  for (const char* key : {"column", "sequential", "gate"})
    if (root.has(key)) root.fail(key, "must be left out, because [[aisle]] describes the gate");
  layout.feel.center_force = 0.0;
  if (root.has("feel")) {
    const TomlTable feel = root.table("feel");
    layout.lines.feel = feel.line();
    layout.feel.center_force = feel.number_or("center_force_n", 0.0, {0.0, 10.0});
    feel.reject_unknown_keys();
  }
  for (const TomlTable& table : root.tables("aisle")) {
    AisleLayout& aisle = layout.aisles.emplace_back();
    aisle.line = table.line();
    for (const char* key : {"from_x_mm", "from_y_mm", "to_x_mm", "to_y_mm"}) (void)table.number(key, {-200.0, 200.0});
    read_parameters(table, aisle);
    table.reject_unknown_keys();
  }
  for (const TomlTable& table : root.tables("place")) {
    layout.places.push_back(read_place(table, static_cast<int>(layout.places.size())));
    table.reject_unknown_keys();
  }
}

}  // namespace

GateLayout read_gate_layout(const std::filesystem::path& file) {
  return parse_gate_layout(read_text_file(file), file.string());
}

GateLayout read_gearbox_layout(const std::filesystem::path& file) {
  GateLayout layout = read_gate_layout(file);
  if (!layout.aisles.empty())
    throw FileError(layout.file, layout.aisles.front().line,
                    "this is no car's gearbox; a gate of aisles can be shown by gate and driven by tour and replay");
  return layout;
}

GateLayout parse_gate_layout(std::string_view text, std::string file_name) {
  GateLayout layout;
  layout.file = std::move(file_name);
  layout.text = text;
  const TomlTable root = TomlTable::parse(text, layout.file);
  layout.name = root.text("name");
  if (root.has("aisle"))
    read_mechanism(root, layout);
  else
    read_comb(root, layout);
  for (const TomlTable& table : root.tables("lockout")) layout.lockouts.push_back(read_lockout(table, layout));
  root.reject_unknown_keys();
  return layout;
}

}  // namespace gearshift::haptics
