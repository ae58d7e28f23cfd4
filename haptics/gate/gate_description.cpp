// Terms as in the paper: junctions are numbered from left to right. A wall pair is two parallel walls of one aisle
// segment, so the paper's gate has 2 horizontal + 6 vertical = 8 pairs. End stops, closed sides of junctions and
// chamfers do not belong to a pair.
#include "haptics/gate/gate_description.h"

#include <algorithm>
#include <utility>

#include "haptics/gate/mechanism_description.h"

namespace gearshift::haptics {
namespace {

constexpr int kNoPair = -1;
constexpr const char* kRoman[kMaxColumns] = {"I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X"};

// One side of a column, forward or back. Depths are |y|.
struct Branch {
  int slot = kNoSlot;
  double sign = 1.0;  // of y
};

Branch branch_of(const Column& column, Side side) {
  return {side == Side::forward ? column.forward_slot : column.back_slot, side == Side::forward ? 1.0 : -1.0};
}

bool is_first(int index) {
  return index == 0;
}
bool is_last(const Gate& gate, int index) {
  return index == gate.column_count - 1;
}

// Length that the chamfer of a slot's mouth cuts off the aisle's wall on one side of the slot (`towards`: -1 left, +1
// right). 0 if there is no slot, or if this is the outermost column on that side.
double mouth_leg(const Gate& gate, int index, Side side, int towards) {
  if (branch_of(column_of(gate, index), side).slot == kNoSlot) return 0.0;
  const bool at_end_wall = towards < 0 ? is_first(index) : is_last(gate, index);
  return at_end_wall ? 0.0 : gate.chamfer;
}

void add_wall(GateDescription& list, glm::dvec2 from, glm::dvec2 to, WallRole role, int pair = kNoPair) {
  if (from != to) list.walls.push_back({from, to, role, pair});
}

int add_pair(GateDescription& list, std::string name, bool horizontal) {
  list.wall_pairs.push_back({std::move(name), horizontal});
  return static_cast<int>(list.wall_pairs.size()) - 1;
}

void describe_aisles(const Gate& gate, GateDescription& list) {
  list.aisles.push_back({"neutral", true, {gate.select_min, -gate.half_aisle}, {gate.select_max, gate.half_aisle}, {}});
  for (const Column& c : columns(gate)) {
    const std::string name = kRoman[list.aisles.size() - 1];
    list.aisles.push_back({name, false, {c.center - c.half_width, c.back}, {c.center + c.half_width, c.forward}, {}});
  }
}

bool has_buffer(const Gate& gate, int index) {
  const auto all = buffers(gate);
  return std::any_of(all.begin(), all.end(),
                     [&](const Buffer& buffer) { return nearest_column(gate, buffer.wall) == index; });
}

void describe_junctions(const Gate& gate, GateDescription& list) {
  for (int i = 0; i < gate.column_count; ++i) {
    const Column& c = column_of(gate, i);
    JunctionInfo junction;
    junction.name = kRoman[i];
    junction.center = {c.center, 0.0};
    junction.left = !is_first(i);
    junction.right = !is_last(gate, i);
    junction.forward = c.forward_slot != kNoSlot;
    junction.back = c.back_slot != kNoSlot;
    junction.buffer = has_buffer(gate, i);
    list.junctions.push_back(junction);
  }
}

// The walls of the neutral aisle between two junctions.
void describe_segment(const Gate& gate, int left, GateDescription& list) {
  const Column& a = column_of(gate, left);
  const Column& b = column_of(gate, left + 1);
  const int pair = add_pair(list, std::string(kRoman[left]) + "-" + kRoman[left + 1], true);
  for (const Side side : {Side::forward, Side::back}) {
    const double y = static_cast<int>(side) * gate.half_aisle;
    const double from = a.center + a.half_width + mouth_leg(gate, left, side, +1);
    const double to = b.center - b.half_width - mouth_leg(gate, left + 1, side, -1);
    add_wall(list, {from, y}, {to, y}, WallRole::aisle, pair);
  }
}

// The walls of one slot, its mouth and its end stop. Without a slot: the wall on the closed side of the junction.
void describe_branch(const Gate& gate, int index, Side side, GateDescription& list) {
  const Column& column = column_of(gate, index);
  const Branch branch = branch_of(column, side);
  const double aisle = branch.sign * gate.half_aisle;
  const double left = column.center - column.half_width;
  const double right = column.center + column.half_width;
  if (branch.slot == kNoSlot) {
    add_wall(list, {left, aisle}, {right, aisle}, WallRole::closed_side);
    return;
  }
  const Slot& slot = slot_of(gate, branch.slot);
  const double end = branch.sign * slot.end;
  const int pair = add_pair(list, gear_name(slot.gear), false);
  for (const int towards : {-1, +1}) {
    const double x = towards < 0 ? left : right;
    const double leg = mouth_leg(gate, index, side, towards);
    const double mouth = aisle + branch.sign * leg;
    add_wall(list, {x + towards * leg, aisle}, {x, mouth}, WallRole::chamfer);
    add_wall(list, {x, mouth}, {x, end}, WallRole::aisle, pair);
  }
  add_wall(list, {left, end}, {right, end}, WallRole::end_stop);
}

void describe_ends(const Gate& gate, GateDescription& list) {
  for (const double x : {gate.select_min, gate.select_max}) {
    add_wall(list, {x, -gate.half_aisle}, {x, gate.half_aisle}, WallRole::closed_side);
  }
}

}  // namespace

const char* to_string(WallRole role) noexcept {
  switch (role) {
    case WallRole::aisle:
      return "aisle";
    case WallRole::chamfer:
      return "chamfer";
    case WallRole::end_stop:
      return "end_stop";
    case WallRole::closed_side:
      return "closed_side";
  }
  return "?";
}

GateDescription describe_gate(const Gate& gate) {
  if (is_mechanism(gate)) return describe_mechanism(gate);
  GateDescription list;
  describe_aisles(gate, list);
  describe_junctions(gate, list);
  for (int i = 0; i + 1 < gate.column_count; ++i) describe_segment(gate, i, list);
  for (int i = 0; i < gate.column_count; ++i) {
    describe_branch(gate, i, Side::forward, list);
    describe_branch(gate, i, Side::back, list);
  }
  describe_ends(gate, list);
  return list;
}

}  // namespace gearshift::haptics
