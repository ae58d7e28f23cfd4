#include "haptics/gate/gate_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
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
    for (int gear = 1; gear <= kMaxGear; ++gear) list.emplace_back(gear_name(gear));
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

// A lockout of a sequential gate may also bar the way from first to neutral.
int read_locked_gear(const TomlTable& table, bool is_sequential) {
  if (!is_sequential) return read_gear(table, "gear");
  const std::vector<std::string> names{gear_name(kReverseGear), gear_name(kNeutralGear)};
  return table.choice("gear", names) == names.front() ? kReverseGear : kNeutralGear;
}

SlotLayout read_slot(const TomlTable& column, std::string_view key) {
  if (!column.has(key)) return {};
  return {read_gear(column, key), column.line(key)};
}

ColumnLayout read_column(const TomlTable& table) {
  ColumnLayout column;
  column.line = table.line();
  read_parameters(table, column, Missing::error);
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
  column.forward = {pulls_up ? kPreviousGear : kNextGear, table.line("up")};
  column.back = {pulls_up ? kNextGear : kPreviousGear, table.line("up")};
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
  static constexpr std::array kKinds{LockoutKind::push_down, LockoutKind::lift, LockoutKind::speed,
                                     LockoutKind::after_gear};
  std::vector<std::string> names;
  names.reserve(kKinds.size());
  for (const LockoutKind kind : kKinds) names.emplace_back(to_string(kind));
  const std::string word = table.choice("kind", names);
  return *std::find_if(kKinds.begin(), kKinds.end(), [&](LockoutKind kind) { return word == to_string(kind); });
}

// Reads the speeds only for a speed lockout. In any other lockout they are therefore rejected as unknown keys instead
// of being ignored.
LockoutLayout read_lockout(const TomlTable& table, bool is_sequential) {
  LockoutLayout lockout;
  lockout.line = table.line();
  lockout.gear = read_locked_gear(table, is_sequential);
  lockout.kind = read_kind(table);
  if (is_sequential && lockout.kind == LockoutKind::after_gear)
    table.fail("kind", "must be push_down, lift or speed in a sequential gate");
  if (lockout.kind == LockoutKind::after_gear) lockout.after_gear = read_gear(table, "after");
  if (lockout.kind == LockoutKind::speed) read_parameters(table, lockout);
  table.reject_unknown_keys();
  return lockout;
}

}  // namespace

GateLayout read_gate_layout(const std::filesystem::path& file) {
  return parse_gate_layout(read_text_file(file), file.string());
}

GateLayout parse_gate_layout(std::string_view text, std::string file_name) {
  GateLayout layout;
  layout.file = std::move(file_name);
  layout.text = text;
  const TomlTable root = TomlTable::parse(text, layout.file);
  layout.name = root.text("name");
  if (root.has("gate")) read_gate(root.table("gate"), layout);
  if (root.has("feel")) read_feel(root.table("feel"), layout);
  if (root.has("sequential"))
    read_sequence(root, layout);
  else
    read_columns(root, layout);
  for (const TomlTable& table : root.tables("lockout"))
    layout.lockouts.push_back(read_lockout(table, layout.sequential_gears > 0));
  root.reject_unknown_keys();
  return layout;
}

}  // namespace gearshift::haptics
