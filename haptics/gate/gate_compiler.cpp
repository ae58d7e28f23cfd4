#include "haptics/gate/gate_compiler.h"

#include <algorithm>
#include <cstddef>

#include "haptics/gate/gate_checks.h"
#include "haptics/gate/gate_curves.h"
#include "haptics/gate/mechanism_compiler.h"

namespace gearshift::haptics {
namespace {

// Width of the paper's rectangular buffer at the closed side of a junction, as a fraction of the slot's width. The
// buffer is wide because its force has a potential: a narrower buffer would pull harder towards the closed wall.
constexpr double kBufferWidthFraction = 0.8;

int add_slot(Gate& gate, int column, Side side, const SlotLayout& from, const GateLayout& layout) {
  if (from.gear == kNeutralGear) return kNoSlot;
  const SlotStations stations = slot_stations(layout);
  Slot& slot = gate.slot[static_cast<std::size_t>(gate.slot_count)];
  slot.column = column;
  slot.side = side;
  slot.gear = from.gear;
  slot.end = stations.end;
  slot.rest = stations.rest;
  slot.engage_depth = stations.engage;
  slot.release_depth = stations.crest;
  slot.feel = make_feel_curve(slot_knots(layout));
  slot.at = {column_of(gate, column).center, static_cast<int>(side) * slot.rest};
  from.label.copy(slot.label.data(), kMaxLabel);
  return gate.slot_count++;
}

void add_column(Gate& gate, const ColumnLayout& from, const GateLayout& layout) {
  const int index = gate.column_count++;
  Column& column = gate.column[static_cast<std::size_t>(index)];
  column.center = from.position;
  column.half_width = layout.slot_width / 2.0;
  column.forward_slot = add_slot(gate, index, Side::forward, from.forward, layout);
  column.back_slot = add_slot(gate, index, Side::back, from.back, layout);
  column.forward = column.forward_slot == kNoSlot ? gate.half_aisle : layout.slot_length;
  column.back = column.back_slot == kNoSlot ? -gate.half_aisle : -layout.slot_length;
}

// `outward`: -1 at the left end of the gate, +1 at the right end.
void add_buffer(Gate& gate, const Column& column, int outward, const GateLayout& layout) {
  Buffer& buffer = gate.buffer[static_cast<std::size_t>(gate.buffer_count++)];
  buffer.wall = column.center + outward * column.half_width;
  buffer.inner = buffer.wall - outward * kBufferWidthFraction * 2.0 * column.half_width;
  buffer.force = layout.feel.buffer_force;
  buffer.back_open = column.back_slot != kNoSlot;
  buffer.forward_open = column.forward_slot != kNoSlot;
}

void add_buffers(Gate& gate, const GateLayout& layout) {
  const auto built = columns(gate);
  if (layout.columns.front().junction == JunctionKind::closed) add_buffer(gate, built.front(), -1, layout);
  if (layout.columns.back().junction == JunctionKind::closed) add_buffer(gate, built.back(), +1, layout);
}

// True if one lateral wall can close off the whole column, as in real gates for reverse. All gears of the column must
// have the same kind of lockout. The column must be at an end of the gate, because the wall blocks everything beyond
// it, and must not be the neutral column. The kind must not be `after_gear`, which concerns shifts within a column.
bool can_be_lateral(const Gate& gate, int column, LockoutKind kind, const GateLayout& layout) {
  const bool at_end = column == 0 || column == gate.column_count - 1;
  if (!at_end || column == gate.neutral_column || kind == LockoutKind::after_gear) return false;
  const auto guarded = [&](int slot) {
    if (slot == kNoSlot) return true;
    const int gear = slot_of(gate, slot).gear;
    return std::any_of(layout.lockouts.begin(), layout.lockouts.end(),
                       [&](const LockoutLayout& l) { return l.gear == gear && l.kind == kind; });
  };
  const Column& c = column_of(gate, column);
  return guarded(c.forward_slot) && guarded(c.back_slot);
}

void add_lockout(Gate& gate, const LockoutLayout& from, const GateLayout& layout) {
  Lockout& lockout = gate.lockout[static_cast<std::size_t>(gate.lockout_count++)];
  lockout.kind = from.kind;
  lockout.slot = slot_of_gear(gate, from.gear);
  lockout.after_gear = from.after_gear;
  lockout.only_after = from.only_after;
  lockout.close_above = from.close_above;
  lockout.open_below = from.open_below;
  if (is_sequential(gate)) {
    lockout.slot = slot_of_gear(gate, kPreviousGear);
    lockout.from_gear = from.gear + 1;
    return;
  }
  const int column = slot_of(gate, lockout.slot).column;
  lockout.lateral = can_be_lateral(gate, column, from.kind, layout);
  if (!lockout.lateral) return;
  lockout.beyond = column < gate.neutral_column ? -1 : +1;
  const double center = column_of(gate, column).center;
  const double neighbour = column_of(gate, column - lockout.beyond).center;
  lockout.barrier = (center + neighbour) / 2.0;
}

}  // namespace

Gate compile_gate(const GateLayout& layout, glm::dvec2 workspace, double radius) {
  if (!layout.aisles.empty()) return compile_mechanism(layout, workspace, radius);
  check_layout(layout, workspace, radius);

  Gate gate;
  gate.half_aisle = layout.aisle_width / 2.0;
  gate.chamfer = layout.chamfer;
  gate.select_min = layout.columns.front().position - layout.slot_width / 2.0;
  gate.select_max = layout.columns.back().position + layout.slot_width / 2.0;
  gate.neutral_column = layout.neutral_column;
  gate.sequential_gears = layout.sequential_gears;
  for (const ColumnLayout& column : layout.columns) add_column(gate, column, layout);
  add_buffers(gate, layout);
  for (const LockoutLayout& lockout : layout.lockouts) add_lockout(gate, lockout, layout);
  gate.aisle_feel = make_feel_curve(aisle_knots(layout));
  gate.select_feel = make_feel_curve(select_knots(layout));
  check_buffers(layout, gate);
  return gate;
}

}  // namespace gearshift::haptics
