// The compiled gate: everything the haptic cycle needs to know about the gate, precomputed and trivially copyable.
//
// Free space is a comb: one horizontal aisle (the neutral aisle) and one vertical aisle per column, joined by chamfered
// mouths. Each of these is convex; the lever's proxy always moves straight inside one of them.
//
//      R   2   4           column: a vertical aisle and its two slots
//    --+---+---+--         neutral aisle, |y| <= half_aisle
//      1   3   5           slot: the branch of a column that ends in a gear
//
// Axes: x = select (right +), y = shift (forward +), origin at neutral centre. [m]
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include <glm/vec2.hpp>

#include "haptics/gate/feel_curve.h"

namespace gearshift::haptics {

inline constexpr int kMaxColumns = 8;
inline constexpr int kMaxSlots = 2 * kMaxColumns;
inline constexpr int kMaxLockouts = 16;
inline constexpr int kReverseGear = -1;
inline constexpr int kNeutralGear = 0;
inline constexpr int kMaxGear = 9;
inline constexpr int kNoSlot = -1;
inline constexpr double kKmhPerMps = 3.6;  // road speeds are km/h in files and on screen, m/s in the code

enum class Side : int { back = -1, forward = 1 };
const char* to_string(Side side) noexcept;

// One branch of a column, with a gear at its end. Depth is |y|, measured from the aisle's centre line. [m]
struct Slot {
  int column = 0;
  Side side = Side::forward;
  int gear = kNeutralGear;     // kReverseGear or 1, 2, ...
  double end = 0.0;            // depth of the end stop
  double rest = 0.0;           // depth at which the engaged lever rests
  double engage_depth = 0.0;   // depth at which the gear becomes engaged
  double release_depth = 0.0;  // depth below which it is released again; < engage_depth
  FeelCurve feel;              // [N] along +depth (positive pulls into the gear)
};

struct Column {
  double center = 0.0;      // x
  double half_width = 0.0;  // of its slots
  double back = 0.0;        // y of its lower end (-half_aisle if there is no slot)
  double forward = 0.0;     // y of its upper end (+half_aisle if there is no slot)
  int back_slot = kNoSlot;
  int forward_slot = kNoSlot;
};

// The paper's rectangular buffer at the closed side of an end junction: the deeper the lever is in it, the more it is
// deflected towards the open vertical aisles. Its force has a potential V, so it cannot supply energy:
//   V = -force g(u) W(y), u = depth into the buffer / width, g = 3u^2 - 2u^3, W' = shape across the aisle
struct Buffer {
  double wall = 0.0;   // x of the closed wall
  double inner = 0.0;  // x where the buffer begins
  double force = 0.0;  // [N] peak deflecting force at the wall
  bool back_open = false;
  bool forward_open = false;
};

enum class LockoutKind : int {
  push_down,  // open while the knob is pushed down (or the reverse button held)
  lift,       // open while the lift ring is held
  speed,      // closed above `close_above`, open again below `open_below`
  after_gear  // closed from the moment a given gear is engaged until the lever has left that gear's column
};

// The name used in layout files: "push_down", "lift", "speed", "after_gear".
const char* to_string(LockoutKind kind) noexcept;

// A wall that opens and closes. It does not close while the lever is beyond it.
struct Lockout {
  LockoutKind kind = LockoutKind::push_down;
  int slot = kNoSlot;    // the slot that the wall blocks
  bool lateral = false;  // true: wall across the neutral aisle at `barrier`; false: wall in the slot's mouth
  double barrier = 0.0;  // [m] x of the lateral wall
  int beyond = 0;        // lateral wall: -1 or +1, the side of the barrier that is blocked
  int after_gear = kNeutralGear;
  double close_above = 0.0;  // [m/s] road speed
  double open_below = 0.0;   // [m/s] road speed, < close_above
};

struct Gate {
  double half_aisle = 0.0;  // half width of the neutral aisle
  double select_min = 0.0;  // ends of the neutral aisle
  double select_max = 0.0;
  double chamfer = 0.0;  // leg of the 45 degree slot mouths, 0 = sharp
  int column_count = 0;
  int neutral_column = 0;
  int slot_count = 0;
  int lockout_count = 0;
  int buffer_count = 0;
  std::array<Column, kMaxColumns> column{};
  std::array<Slot, kMaxSlots> slot{};
  std::array<Lockout, kMaxLockouts> lockout{};
  std::array<Buffer, 2> buffer{};
  FeelCurve select_feel;  // [N] along +x: centring on the neutral column
  FeelCurve aisle_feel;   // [N] along +|y|: centring in the neutral aisle
};
static_assert(std::is_trivially_copyable_v<Gate>);

// The used elements of the arrays of Gate.
inline std::span<const Column> columns(const Gate& gate) noexcept {
  return {gate.column.data(), static_cast<std::size_t>(gate.column_count)};
}
inline std::span<const Slot> slots(const Gate& gate) noexcept {
  return {gate.slot.data(), static_cast<std::size_t>(gate.slot_count)};
}
inline std::span<const Lockout> lockouts(const Gate& gate) noexcept {
  return {gate.lockout.data(), static_cast<std::size_t>(gate.lockout_count)};
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

// Column whose centre is nearest to x.
int nearest_column(const Gate& gate, double x) noexcept;

// The slot of `gear`, or kNoSlot.
int slot_of_gear(const Gate& gate, int gear) noexcept;

// Rest position of the lever in a gear (neutral: the neutral column's junction). [m]
glm::dvec2 rest_position(const Gate& gate, int gear) noexcept;

// "R", "N", "1", ...; "?" beyond kMaxGear.
const char* gear_name(int gear) noexcept;

// Whether the point is in free space with all lockouts open. `slack` [m] moves every wall outwards.
bool in_free_space(const Gate& gate, glm::dvec2 point, double slack = 0.0) noexcept;

}  // namespace gearshift::haptics
