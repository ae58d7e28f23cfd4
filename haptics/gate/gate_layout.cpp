#include "haptics/gate/gate_layout.h"

#include <algorithm>
#include <array>
#include <utility>

#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"

namespace gearshift::haptics {
namespace {

constexpr double kMetresPerMillimetre = 1e-3;
constexpr double kMillimetresPerMetre = 1e3;

// Allowed ranges of the values in a layout file, in the units of the file.
constexpr Range kPositionMm{-200.0, 200.0};
constexpr Range kAisleWidthMm{kMinAisleWidth * kMillimetresPerMetre, 40.0};
constexpr Range kSlotWidthMm{kMinAisleWidth * kMillimetresPerMetre, 30.0};
constexpr Range kSlotLengthMm{kMinSlotProper * kMillimetresPerMetre, 120.0};
constexpr Range kChamferMm{0.0, 10.0};
constexpr Range kSpeedKmh{0.0, 400.0};

// Allowed forces. The largest lock force is less than 31.7 N, the peak force of the paper's lever, because a lock must
// leave part of this force for the walls.
constexpr Range kCenterForceN{0.5, 10.0};
constexpr Range kAisleForceN{0.0, 5.0};
constexpr Range kMouthForceN{0.0, 15.0};
constexpr Range kDetentForceN{0.0, 20.0};
constexpr Range kLockForceN{1.0, 25.0};
constexpr Range kBufferForceN{0.0, 10.0};

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

SlotLayout read_slot(const TomlTable& column, std::string_view key) {
  if (!column.has(key)) return {};
  return {read_gear(column, key), column.line(key)};
}

ColumnLayout read_column(const TomlTable& table) {
  ColumnLayout column;
  column.line = table.line();
  column.position = table.number("position_mm", kPositionMm) * kMetresPerMillimetre;
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

void read_gate(const TomlTable& table, GateLayout& layout) {
  const auto length = [&](std::string_view key, double fallback, Range range) {
    return table.has(key) ? table.number(key, range) * kMetresPerMillimetre : fallback;
  };
  layout.aisle_width = length("aisle_width_mm", layout.aisle_width, kAisleWidthMm);
  layout.slot_width = length("slot_width_mm", layout.slot_width, kSlotWidthMm);
  layout.slot_length = length("slot_length_mm", layout.slot_length, kSlotLengthMm);
  layout.chamfer = length("chamfer_mm", layout.chamfer, kChamferMm);
  layout.lines.gate = table.line();
  layout.lines.slot_length = table.line("slot_length_mm");
  table.reject_unknown_keys();
}

void read_feel(const TomlTable& table, GateLayout& layout) {
  FeelLayout& feel = layout.feel;
  feel.center_force = table.number_or("center_force_n", feel.center_force, kCenterForceN);
  feel.aisle_force = table.number_or("aisle_force_n", feel.aisle_force, kAisleForceN);
  feel.mouth_force = table.number_or("mouth_force_n", feel.mouth_force, kMouthForceN);
  feel.detent_force = table.number_or("detent_force_n", feel.detent_force, kDetentForceN);
  feel.lock_force = table.number_or("lock_force_n", feel.lock_force, kLockForceN);
  feel.buffer_force = table.number_or("buffer_force_n", feel.buffer_force, kBufferForceN);
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
LockoutLayout read_lockout(const TomlTable& table) {
  LockoutLayout lockout;
  lockout.line = table.line();
  lockout.gear = read_gear(table, "gear");
  lockout.kind = read_kind(table);
  if (lockout.kind == LockoutKind::after_gear) lockout.after_gear = read_gear(table, "after");
  if (lockout.kind == LockoutKind::speed) {
    const auto speed = [&](std::string_view key, double fallback) {
      return table.has(key) ? table.number(key, kSpeedKmh) / kKmhPerMps : fallback;
    };
    lockout.close_above = speed("close_above_kmh", lockout.close_above);
    lockout.open_below = speed("open_below_kmh", lockout.open_below);
  }
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
  read_columns(root, layout);
  for (const TomlTable& table : root.tables("lockout")) layout.lockouts.push_back(read_lockout(table));
  root.reject_unknown_keys();
  return layout;
}

}  // namespace gearshift::haptics
