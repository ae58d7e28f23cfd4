// Determines which lockouts are closed and how they limit free space.
#pragma once

#include <cstdint>
#include <string>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift::haptics {

// How lockouts and gearbox limit free space in this cycle.
struct Passage {
  double select_min = 0.0;  // [m] ends of the neutral aisle, narrowed by lateral lockouts
  double select_max = 0.0;
  std::uint32_t closed = 0;    // one bit per slot: 1 if a wall closes the slot's mouth
  int held_slot = kNoSlot;     // place of a mechanism that the lever may not leave
  int limited_slot = kNoSlot;  // slot in which synchroniser or torque lock limit the depth
  double depth_min = 0.0;      // [m] allowed range of depth in limited_slot
  double depth_max = 0.0;
};

Passage open_passage(const Gate& gate) noexcept;  // everything open

struct LockoutInputs {
  bool pressed_down = false;
  bool lifted = false;
  double road_speed = 0.0;  // [m/s] magnitude counts
  int gear = kNeutralGear;  // engaged now
  double brake = 0.0;       // [1] pedal, 0 to 1
};

// State of all lockouts: the hysteresis of the speed lockouts and the last gear of the `after_gear` lockouts.
class Lockouts {
 public:
  // Updates the lockouts and returns the limits of free space. `proxy`: position of the drawn lever [m]. A wall does
  // not close while the lever is beyond it. Real-time safe.
  Passage update(const Gate& gate, const LockoutInputs& in, glm::dvec2 proxy) noexcept;

 private:
  std::uint32_t latched_ =
      0;  // one bit per lockout: 1 if closed by speed or by the last gear, for `only_after` if open
};

inline constexpr double kBrakePressed = 0.1;  // [1] travel of the pedal at which its switch opens `brake` lockouts
bool has_brake_lockout(const Gate& gate) noexcept;

int locked_gear(const Gate& gate, const Lockout& lockout) noexcept;  // the gear that is out of reach while it is closed
std::string describe(const Lockout& lockout);  // for example "closed above 20, open below 15 km/h"

}  // namespace gearshift::haptics
