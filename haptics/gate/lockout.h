// Which movable walls are closed right now, and what that leaves of the free space.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"

namespace gearshift {

// What is open of the free space this cycle. Part of every proxy move.
struct Passage {
  double select_min = 0.0;  // [m] neutral aisle, narrowed by lateral lockouts
  double select_max = 0.0;
  std::uint32_t closed = 0;    // bit per slot: its mouth ends in a wall
  int limited_slot = kNoSlot;  // the slot whose depth the gearbox limits (synchroniser, torque lock)
  double depth_min = 0.0;      // [m] limits in that slot
  double depth_max = 0.0;
};

Passage open_passage(const Gate& gate) noexcept;  // everything open

struct LockoutInputs {
  bool pressed_down = false;
  bool lifted = false;
  double road_speed = 0.0;  // [m/s] magnitude counts
  int gear = kNeutralGear;  // engaged now
};

// Remembers what a lockout must remember: the speed's hysteresis and the last gear.
class Lockouts {
 public:
  // Passage for a proxy at `proxy` [m]. A wall never closes on a lever that is beyond it. Real-time safe.
  Passage update(const Gate& gate, const LockoutInputs& in, glm::dvec2 proxy) noexcept;

 private:
  std::uint32_t latched_ = 0;  // bit per lockout: closed by speed or by the last gear
};

}  // namespace gearshift
