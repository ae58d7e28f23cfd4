#include "haptics/gate/gate_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "haptics/files/file_error.h"
#include "haptics/files/number_text.h"
#include "haptics/gate/gate_curves.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift::haptics {
namespace {

[[noreturn]] void fail(const GateLayout& layout, int line, const std::string& reason) {
  throw FileError(layout.file, line, reason);
}

std::string column_text(const ColumnLayout& column) {
  return "the column at " + millimetres_text(column.position);
}

std::vector<SlotLayout> gears_of(const ColumnLayout& column) {
  std::vector<SlotLayout> slots;
  for (const SlotLayout& slot : {column.forward, column.back}) {
    if (slot.gear != kNeutralGear) slots.push_back(slot);
  }
  return slots;
}

// The gears of the columns from `first` to `last` as text, for example "1 and 2".
std::string gear_list(const GateLayout& layout, std::size_t first, std::size_t last) {
  std::string list;
  for (std::size_t i = first; i < last; ++i) {
    for (const SlotLayout& slot : gears_of(layout.columns[i])) {
      list += (list.empty() ? "" : " and ") + std::string(gear_name(slot.gear));
    }
  }
  return list;
}

void check_widths(const GateLayout& layout) {
  const double narrowest = std::min(layout.aisle_width, layout.slot_width);
  // The condition is negated so that NaN is rejected as well.
  if (!(narrowest >= kMinAisleWidth)) {
    fail(layout, layout.lines.gate,
         "an aisle of " + millimetres_text(narrowest) + " is too narrow; it must be at least " +
             millimetres_text(kMinAisleWidth) + " wide");
  }
  if (!(layout.chamfer >= 0.0)) fail(layout, layout.lines.gate, "the chamfer must not be negative");
}

void check_column_count(const GateLayout& layout) {
  const std::size_t count = layout.columns.size();
  if (count < 1 || count > kMaxColumns) {
    const int line = count > kMaxColumns ? layout.columns[kMaxColumns].line : layout.lines.gate;
    fail(layout, line,
         "a gate must have between 1 and " + std::to_string(kMaxColumns) + " columns, but this one has " +
             std::to_string(count));
  }
  if (layout.neutral_column < 0 || layout.neutral_column >= static_cast<int>(count)) {
    fail(layout, layout.lines.gate, "the neutral column is not one of the columns");
  }
}

void check_spacing(const GateLayout& layout) {
  const double required = layout.slot_width + 2.0 * layout.chamfer + kMinWall;
  for (std::size_t i = 1; i < layout.columns.size(); ++i) {
    const ColumnLayout& column = layout.columns[i];
    const double spacing = column.position - layout.columns[i - 1].position;
    if (!(spacing > 0.0)) {
      fail(layout, column.line,
           column_text(column) + " is not to the right of the previous one; list the columns from left to right");
    }
    if (!(spacing >= required - 1e-9)) {
      fail(layout, column.line,
           column_text(column) + " overlaps the previous one, because slots of this width and chamfer need " +
               millimetres_text(required) + " from centre to centre, but have " + millimetres_text(spacing));
    }
  }
}

// The closed side of a junction deflects the lever into the column's slots, so no column may lie beyond this side.
void check_junctions(const GateLayout& layout) {
  const std::size_t count = layout.columns.size();
  for (std::size_t i = 0; i < count; ++i) {
    const ColumnLayout& column = layout.columns[i];
    if (gears_of(column).empty())
      fail(layout, column.line, column_text(column) + " has no gear; write forward or back");
    if (column.junction == JunctionKind::open) continue;
    const bool inner = i > 0 && i + 1 < count;
    if (!inner && static_cast<int>(i) == layout.neutral_column) {
      fail(layout, column.line,
           "the neutral column's junction cannot be closed, because the buffer would push the lever out of neutral");
    }
    if (!inner) continue;
    const bool right_of_neutral = static_cast<int>(i) >= layout.neutral_column;
    const std::string unreachable = right_of_neutral ? gear_list(layout, i + 1, count) : gear_list(layout, 0, i);
    fail(layout, column.line,
         "only an end column can have a closed junction; here it would block the way to gear " + unreachable);
  }
}

void check_gears(const GateLayout& layout) {
  if (layout.sequential_gears > 0) return;  // read_gate_layout() has checked the number
  constexpr std::size_t kGears = kMaxGateGear - kReverseGear + 1;
  const auto at = [](int gear) {
    const int index = gear - kReverseGear;
    return static_cast<std::size_t>(index);
  };
  std::array<int, kGears> line_of{};  // line in the file where each gear was first seen; 0: not yet
  std::array<bool, kGears> is_present{};
  int highest = 0;
  for (const ColumnLayout& column : layout.columns) {
    for (const SlotLayout& slot : gears_of(column)) {
      if (slot.gear < kReverseGear || slot.gear > kMaxGateGear) {
        fail(layout, slot.line, "a gear must be R or a number from 1 to " + std::to_string(kMaxGateGear));
      }
      const std::size_t gear = at(slot.gear);
      if (is_present[gear]) {
        fail(layout, slot.line,
             "gear " + std::string(gear_name(slot.gear)) + " is already on line " + std::to_string(line_of[gear]));
      }
      is_present[gear] = true;
      line_of[gear] = slot.line;
      highest = std::max(highest, slot.gear);
    }
  }
  if (highest < 1) fail(layout, layout.columns.front().line, "a gate must have a forward gear");
  for (int gear = 1; gear < highest; ++gear) {
    if (!is_present[at(gear)]) {
      fail(layout, line_of[at(highest)],
           "there is a gear " + std::string(gear_name(highest)) + " but no gear " + gear_name(gear));
    }
  }
}

double steepest(const std::vector<FeelKnot>& knots) {
  return steepest(make_feel_curve(knots));
}

void check_feel(const GateLayout& layout) {
  const SlotStations s = slot_stations(layout);
  const double length = s.end - s.mouth;
  if (!(length >= kMinSlotProper)) {
    fail(layout, layout.lines.slot_length,
         "slot_length_mm is too short; with this aisle and chamfer it must be at least " +
             millimetres_text(s.mouth + kMinSlotProper));
  }
  const std::string limit = number_text(kMaxFeelSlope) + " N/m and feel like a wall";
  if (!(steepest(aisle_knots(layout)) <= kMaxFeelSlope)) {
    fail(layout, layout.lines.feel,
         "aisle_force_n is too large for such a narrow aisle; the force would rise more steeply than " + limit);
  }
  if (!(steepest(select_knots(layout)) <= kMaxFeelSlope)) {
    fail(layout, layout.lines.feel,
         "center_force_n or spring_n is too large for such narrow slots; the force would rise more steeply than " +
             limit);
  }
  const double slope = steepest(slot_knots(layout));
  if (!(slope <= kMaxFeelSlope)) {
    fail(layout, layout.lines.slot_length,
         "slot_length_mm is too short; below " + millimetres_text(s.mouth + length * slope / kMaxFeelSlope) +
             " the slot's forces would rise more steeply than " + limit);
  }
}

void check_return(const GateLayout& layout) {
  const double neutral = layout.columns[static_cast<std::size_t>(layout.neutral_column)].position;
  const double required = required_return_force(std::abs(neutral));
  if (layout.feel.center_force == 0.0 || layout.feel.center_force >= required) return;
  fail(layout, layout.lines.feel,
       "center_force_n = " + number_text(layout.feel.center_force) + ": must be at least " +
           number_text(std::ceil(10.0 * required) / 10.0) +
           ", or the lever would not return to the neutral column at " + millimetres_text(neutral) +
           "; or 0, if nothing returns it");
}

// Largest allowed distance [m] of a side wall from the centre, for slots of this depth. Rounded down to 0.1 mm.
double outermost_wall(glm::dvec2 workspace, double radius, double depth) {
  const double y = depth + kWorkspaceMargin;
  const auto ellipse = [y](double half_x, double half_y) {
    return half_x * std::sqrt(std::max(0.0, 1.0 - (y / half_y) * (y / half_y)));
  };
  const double reach = std::min(ellipse(workspace.x, radius), ellipse(radius, workspace.y));
  return std::floor(1e4 * std::max(0.0, reach - kWorkspaceMargin)) * 1e-4;
}

// Checks that the tip reaches the outer corners of the slots, where both joints are deflected most.
void check_corners(const GateLayout& layout, glm::dvec2 workspace, double radius) {
  const double depth = layout.slot_length;
  for (const ColumnLayout& column : layout.columns) {
    const double wall = std::abs(column.position) + layout.slot_width / 2.0;
    if (reaches(workspace, radius, glm::dvec2(wall, depth) + glm::dvec2(kWorkspaceMargin))) continue;
    fail(layout, column.line,
         column_text(column) + " has its wall at " + millimetres_text(wall) +
             ", outside the workspace, which is narrower at its corners; with end stops at " + millimetres_text(depth) +
             ", walls must lie within " + millimetres_text(outermost_wall(workspace, radius, depth)) +
             " of the centre");
  }
}

void check_workspace(const GateLayout& layout, glm::dvec2 workspace, double radius) {
  const glm::dvec2 reach = workspace - glm::dvec2(kWorkspaceMargin);
  const std::string device = "the device reaches " + millimetres_text(workspace.x) + " sideways and " +
                             millimetres_text(workspace.y) + " fore and aft, and walls must stay " +
                             millimetres_text(kWorkspaceMargin) + " inside these limits";
  for (const ColumnLayout& column : layout.columns) {
    const double wall = std::abs(column.position) + layout.slot_width / 2.0;
    if (!(wall <= reach.x)) {
      fail(layout, column.line,
           column_text(column) + " has its wall at " + millimetres_text(wall) + ", outside the workspace; " + device);
    }
  }
  if (!(layout.slot_length <= reach.y)) {
    fail(layout, layout.lines.slot_length,
         "slot_length_mm puts the end stops at " + millimetres_text(layout.slot_length) + ", outside the workspace; " +
             device);
  }
  check_corners(layout, workspace, radius);
}

int column_of_gear(const GateLayout& layout, int gear) {
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const ColumnLayout& column = layout.columns[i];
    if (column.forward.gear == gear || column.back.gear == gear) return static_cast<int>(i);
  }
  return -1;
}

void check_after_gear(const GateLayout& layout, const LockoutLayout& lockout) {
  const std::string gear = gear_name(lockout.gear);
  if (lockout.after_gear == lockout.gear) {
    fail(layout, lockout.line,
         "gear " + gear + " could never be engaged, because its lockout would open only after the same gear");
  }
  if (column_of_gear(layout, lockout.after_gear) != column_of_gear(layout, lockout.gear)) {
    fail(layout, lockout.line,
         "a lockout of gear " + gear + " after gear " + gear_name(lockout.after_gear) +
             " needs both gears in the same column");
  }
}

void check_only_after(const GateLayout& layout, const LockoutLayout& lockout) {
  const std::string gear = gear_name(lockout.gear);
  if (includes_gear(lockout.only_after, lockout.gear)) {
    fail(layout, lockout.line,
         "gear " + gear + " must not be in its own list, because it could never be engaged first");
  }
  for (int other = kReverseGear; other <= kMaxGateGear; ++other) {
    if (includes_gear(lockout.only_after, other) && column_of_gear(layout, other) < 0)
      fail(layout, lockout.line,
           "gear " + gear + " is to be open after gear " + gear_name(other) + ", but the gate has no such gear");
  }
}

// A spring of its own stiffens the way to a column and to all beyond it.
void check_springs(const GateLayout& layout) {
  for (std::size_t i = 0; i < layout.columns.size(); ++i) {
    const ColumnLayout& column = layout.columns[i];
    if (column.spring_force == 0.0) continue;
    if (layout.sequential_gears > 0 || static_cast<int>(i) == layout.neutral_column)
      fail(layout, column.line, column_text(column) + " is neutral and can have no spring_n");
    if (column.spring_force < layout.feel.center_force)
      fail(layout, column.line,
           "spring_n = " + number_text(column.spring_force) +
               ": must not be less than center_force_n = " + number_text(layout.feel.center_force));
  }
}

void check_lockouts(const GateLayout& layout) {
  if (layout.lockouts.size() > kMaxLockouts) {
    fail(layout, layout.lockouts[kMaxLockouts].line,
         "a gate can have at most " + std::to_string(kMaxLockouts) + " lockouts");
  }
  for (const LockoutLayout& lockout : layout.lockouts) {
    if (lockout.kind == LockoutKind::speed && !(lockout.open_below < lockout.close_above)) {
      fail(layout, lockout.line,
           "open_below_kmh must be smaller than close_above_kmh, or the lockout would open and close rapidly");
    }
    if (layout.sequential_gears > 0) continue;
    if (lockout.gear == kNeutralGear || column_of_gear(layout, lockout.gear) < 0) {
      fail(layout, lockout.line,
           "this lockout is for gear " + std::string(gear_name(lockout.gear)) + ", but the gate has no such gear");
    }
    if (lockout.kind == LockoutKind::after_gear) check_after_gear(layout, lockout);
    if (lockout.kind == LockoutKind::only_after) check_only_after(layout, lockout);
  }
}

}  // namespace

double steepest(const FeelCurve& curve) noexcept {
  const SlopeRange range = slope_range(curve);
  return std::max(range.max, -range.min);
}

// The handle of the paper's joystick has a spring (eq (11)) that pulls towards the middle of the workspace.
double required_return_force(double distance) noexcept {
  constexpr double kHandleStiffness = 14.8;  // [N/m]
  constexpr double kReturnMargin = 1.2;
  constexpr double kMinReturnForce = 0.5;  // [N] required beyond the spring's force, to overcome dry friction
  return kMinReturnForce + kReturnMargin * kHandleStiffness * distance;
}

bool reaches(glm::dvec2 half, double radius, glm::dvec2 point) noexcept {
  const auto inside = [](double x, double y) { return x * x + y * y <= 1.0; };
  return inside(point.x / half.x, point.y / radius) && inside(point.x / radius, point.y / half.y);
}

// The buffer's force has a potential, so wherever it pushes across the aisle it also pulls along the aisle, towards the
// closed wall. This pull is largest half-way into the buffer, at the aisle wall next to an open slot. It must be less
// than the centring force.
void check_buffers(const GateLayout& layout, const Gate& gate) {
  const double center = layout.feel.center_force;
  for (const Buffer& buffer : buffers(gate)) {
    const glm::dvec2 at{0.5 * (buffer.wall + buffer.inner), buffer.forward_open ? gate.half_aisle : -gate.half_aisle};
    const double outward = buffer.wall > buffer.inner ? 1.0 : -1.0;
    const double pull = outward * gate_feel(gate, at).x + center;
    if (buffer.force <= 0.0 || pull < center) continue;
    fail(layout, layout.lines.feel,
         "buffer_force_n = " + number_text(buffer.force) +
             " would hold the lever at a closed junction; there the buffer pulls the lever with " +
             number_text(pull, 2) + " N, but center_force_n is only " + number_text(center));
  }
}

void check_layout(const GateLayout& layout, glm::dvec2 workspace, double radius) {
  check_widths(layout);
  check_column_count(layout);
  check_spacing(layout);
  check_junctions(layout);
  check_gears(layout);
  check_springs(layout);
  check_feel(layout);
  check_return(layout);
  check_workspace(layout, workspace, radius);
  check_lockouts(layout);
}

}  // namespace gearshift::haptics
