// The compiled gate: all data about the gate that the haptic cycle needs, precomputed and trivially copyable.
//
// The free space of an H gate has the shape of a comb: one horizontal aisle (the neutral aisle) and one vertical aisle
// per column, joined by chamfered mouths. Each aisle and each mouth is convex. The proxy, which represents the lever in free space,
// always moves in a straight line inside one aisle or mouth.
//
//      R   2   4           column: a vertical aisle and its two slots
//    --+---+---+--         neutral aisle, |y| <= half_aisle
//      1   3   5           slot: the branch of a column that ends in a gear
//
// A sequential gate has one column. Each stroke into one of its slots turns the shift drum by one gear, and a spring
// returns the lever. The order is that of racing gearboxes and of simulators, for example of TORCS
// (src/drivers/human/human.cpp): R N 1 2 3 ..., where neutral and reverse may be locked out on the way down.
//
// The free space of any other mechanism is a union of straight aisles with round ends, at any angle. Its slots are
// places on the aisles' centre lines; the depth of the lever in a slot is then how far it is inside the place's edge.
//
// Axes: x = select (right +), y = shift (forward +), origin at neutral centre. [m]
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "haptics/gate/feel_curve.h"

namespace gearshift::haptics {

inline constexpr int kMaxColumns = 10;
inline constexpr int kMaxSlots = 2 * kMaxColumns;
inline constexpr int kMaxAisles = 16;
inline constexpr int kMaxLockouts = 16;
inline constexpr std::size_t kMaxLabel = 7;  // [bytes] of a label
inline constexpr int kReverseGear = -1;
inline constexpr int kNeutralGear = 0;
inline constexpr int kMaxGear = 9;       // of a car
inline constexpr int kMaxGateGear = 18;  // of a gate
// The slots of a sequential gate: they lead to the next and to the previous gear of R N 1 2 3 ...
inline constexpr int kNextGear = 100;
inline constexpr int kPreviousGear = 101;
// Places of other mechanisms that are no gear, such as P or D: this number and the following ones.
inline constexpr int kFirstPosition = 200;
inline constexpr int kAnyGear = -2;
inline constexpr int kNoSlot = -1;

enum class Side : int { back = -1, forward = 1 };
const char* to_string(Side side) noexcept;

// One branch of a column, with a gear at its end. All depths are |y|, measured from the neutral aisle's centre line.
// [m] In a mechanism of other aisles: a place. Depths are `end` - |p - at|, so that `end` is the place's radius.
struct Slot {
  int column = 0;  // only in an H gate, as is `side`
  Side side = Side::forward;
  int gear = kNeutralGear;     // kReverseGear, or a forward gear 1, 2, ...; of a place also 0 or a position
  double end = 0.0;            // depth of the end stop
  double rest = 0.0;           // depth at which the engaged lever rests
  double engage_depth = 0.0;   // depth at which the gear becomes engaged
  double release_depth = 0.0;  // depth below which the gear is released; less than engage_depth
  FeelCurve feel;              // [N] force along the slot; positive pulls into the gear
  glm::dvec2 at{0.0};          // rest position
  std::uint32_t aisles = 0;    // of a place: one bit per aisle, 1 if the place is on its centre line
  std::array<char, kMaxLabel + 1> label{};  // as written in the file; empty: the gear's name
};

// A straight aisle with round ends: all points within `half_width` of the line between both ends. [m]
struct Aisle {
  glm::dvec2 from{0.0}, to{0.0};
  glm::dvec2 along{0.0};  // unit vector
  double length = 0.0;
  double half_width = 0.0;
  FeelCurve spring;  // [N] force along `along` against the distance from `from`; zero where other aisles meet this one
};

struct Column {
  double center = 0.0;      // x
  double half_width = 0.0;  // half width of its slots
  double back = 0.0;        // y of its back end (-half_aisle without a back slot)
  double forward = 0.0;     // y of its front end (+half_aisle without a forward slot)
  int back_slot = kNoSlot;
  int forward_slot = kNoSlot;
};

// The paper's rectangular buffer at the closed side of an end junction. The deeper the lever is in the buffer, the
// harder the buffer pushes it towards the open vertical aisles. This force has a potential V, so it supplies no energy:
//   V = -force g(u) W(y), u = (depth into the buffer) / width, g = 3 u^2 - 2 u^3, dW/dy = shape across the aisle
struct Buffer {
  double wall = 0.0;   // [m] x of the closed wall
  double inner = 0.0;  // [m] x where the buffer begins
  double force = 0.0;  // [N] largest deflecting force, reached at the wall
  bool back_open = false;
  bool forward_open = false;
};

enum class LockoutKind : int {
  push_down,   // open while the knob is pushed down or the reverse button is held
  lift,        // open while the lift ring is held
  speed,       // closes above speed `close_above`, opens again below speed `open_below`
  after_gear,  // closes when the gear `after_gear` is engaged, opens when the lever has left that gear's column
  only_after,  // open while one of `only_after` was the last gear engaged
  brake        // open while the brake is pressed
};

// The name of a lockout kind in layout files: "push_down", "lift", "speed", "after_gear", "only_after" or "brake".
const char* to_string(LockoutKind kind) noexcept;

// A wall that opens and closes. The wall stays open while the lever is beyond it.
struct Lockout {
  LockoutKind kind = LockoutKind::push_down;
  int slot = kNoSlot;    // the slot that the wall blocks
  bool lateral = false;  // true: wall across the neutral aisle at `barrier`; false: wall in the slot's mouth
  double barrier = 0.0;  // [m] x of the wall, if lateral
  int beyond = 0;        // if lateral: the blocked side of the barrier, -1 (left) or +1 (right)
  int after_gear = kNeutralGear;
  std::uint32_t only_after = 0;  // one bit per gear, from kReverseGear on
  int from_gear = kAnyGear;      // the wall stands only while this gear is engaged; for sequential gates
  bool is_leaving = false;       // the wall keeps the lever in the place instead of out of it; not in an H gate
  double close_above = 0.0;      // [m/s] road speed
  double open_below = 0.0;       // [m/s] road speed, less than close_above
};

struct Gate {
  double half_aisle = 0.0;  // half width of the neutral aisle
  double select_min = 0.0;  // [m] left end of the neutral aisle
  double select_max = 0.0;
  double chamfer = 0.0;  // leg of the 45 degree chamfer at slot mouths; 0: sharp corners
  int column_count = 0;
  int neutral_column = 0;
  int slot_count = 0;
  int lockout_count = 0;
  int buffer_count = 0;
  int sequential_gears = 0;  // number of forward gears of a sequential gate; 0: each gear has its own slot
  int aisle_count = 0;       // 0: an H gate or a sequential gate
  std::array<Column, kMaxColumns> column{};
  std::array<Slot, kMaxSlots> slot{};
  std::array<Lockout, kMaxLockouts> lockout{};
  std::array<Buffer, 2> buffer{};
  std::array<Aisle, kMaxAisles> aisle{};
  FeelCurve return_feel;  // [N] of a mechanism: force away from the neutral place against the distance from it
  FeelCurve select_feel;  // [N] force along +x that centres the lever on the neutral column
  FeelCurve aisle_feel;   // [N] force along +|y| that centres the lever in the neutral aisle
};
static_assert(std::is_trivially_copyable_v<Gate>);

// One bit per gear, for Lockout::only_after.
inline std::uint32_t gear_bit(int gear) noexcept {
  return 1u << (gear - kReverseGear);
}
inline bool includes_gear(std::uint32_t set, int gear) noexcept {
  return gear >= kReverseGear && gear <= kMaxGateGear && (set & gear_bit(gear)) != 0;
}

// The used elements of the fixed-size arrays in Gate.
inline std::span<const Column> columns(const Gate& gate) noexcept {
  return {gate.column.data(), static_cast<std::size_t>(gate.column_count)};
}
inline std::span<const Slot> slots(const Gate& gate) noexcept {
  return {gate.slot.data(), static_cast<std::size_t>(gate.slot_count)};
}
inline std::span<const Lockout> lockouts(const Gate& gate) noexcept {
  return {gate.lockout.data(), static_cast<std::size_t>(gate.lockout_count)};
}
inline std::span<const Aisle> aisles(const Gate& gate) noexcept {
  return {gate.aisle.data(), static_cast<std::size_t>(gate.aisle_count)};
}
inline std::span<const Buffer> buffers(const Gate& gate) noexcept {
  return {gate.buffer.data(), static_cast<std::size_t>(gate.buffer_count)};
}
inline const Column& column_of(const Gate& gate, int index) noexcept {
  return gate.column[static_cast<std::size_t>(index)];
}
inline const Slot& slot_of(const Gate& gate, int index) noexcept {
  return gate.slot[static_cast<std::size_t>(index)];
}

// Index of the column whose centre is nearest to x. Inline, because the haptic cycle calls it several times.
inline int nearest_column(const Gate& gate, double x) noexcept {
  int nearest = 0;
  double least = std::abs(gate.column[0].center - x);
  for (int i = 1; i < gate.column_count; ++i) {
    const double distance = std::abs(column_of(gate, i).center - x);
    if (distance < least) {
      nearest = i;
      least = distance;
    }
  }
  return nearest;
}

inline bool is_sequential(const Gate& gate) noexcept {
  return gate.sequential_gears > 0;
}

// True for a union of aisles that is neither an H gate nor a sequential gate.
inline bool is_mechanism(const Gate& gate) noexcept {
  return gate.aisle_count > 0;
}

// Depth [m] of the point in this slot.
inline double depth_in(const Gate& gate, int slot, glm::dvec2 point) noexcept {
  if (!is_mechanism(gate)) return std::abs(point.y);
  return slot_of(gate, slot).end - glm::distance(point, slot_of(gate, slot).at);
}

// True for a gear that can be engaged, neutral included.
bool has_gear(const Gate& gate, int gear) noexcept;

// The gear that the lever engages at the end of `slot` while `engaged` is engaged. At the end of a sequence it is
// `engaged` itself.
int gear_behind(const Gate& gate, int slot, int engaged) noexcept;

// Index of the slot of `gear`; kNoSlot if the gate has no such gear, or is sequential.
int slot_of_gear(const Gate& gate, int gear) noexcept;

// Position [m] of the lever at rest in a gear. In neutral this is the neutral column's junction.
glm::dvec2 rest_position(const Gate& gate, int gear) noexcept;

// Name of a gear: "R", "N", "1", "2", ...; "+" and "-" for the slots of a sequential gate; otherwise "?".
const char* gear_name(int gear) noexcept;

// The gear's label in this gate. The text belongs to the gate.
const char* gear_label(const Gate& gate, int gear) noexcept;

// True if the point is in free space with all lockouts open. `slack` [m] moves every wall outwards.
bool in_free_space(const Gate& gate, glm::dvec2 point, double slack = 0.0) noexcept;

}  // namespace gearshift::haptics
