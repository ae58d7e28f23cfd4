// Softens a wall on which the lever chatters: what no model foresaw is seen in the motion.
//
// A hand does not reverse a lever six times in a quarter of a second; a wall that is too stiff for its device does.
// Then the wall's stiffness falls by a quarter, and again, down to a floor that holds on any device of this mass and
// delay. It stays there until the loop is armed anew or tuned. A bounce that dies away by itself takes little or
// nothing; only what chatters on at the floor, for many times six reversals, is beyond softening.
#pragma once

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"

namespace gearshift {

class ReversalLimiter {
 public:
  ReversalLimiter(const DeviceSpec& spec, double period) noexcept;  // period [s]

  void reset() noexcept;  // full stiffness again

  // Once per cycle, with the trusted position [m], whether the lever is pressed into a wall, and the stiffness that
  // is wanted of that wall [N/m]. True when share() or exhausted() has just changed. Real-time safe.
  bool update(glm::dvec2 position, bool touches, double wanted) noexcept;

  double share() const noexcept { return share_; }                       // [1] of the wanted stiffness to be used
  bool exhausted() const noexcept { return at_floor_ >= kMostAtFloor; }  // softening does not help

 private:
  static constexpr std::size_t kReversals = 6;
  static constexpr int kMostAtFloor = 8;  // times six reversals, without a pause

  // The turning points of one axis: a turn counts once the lever has come back from it by kTurn counts.
  struct Axis {
    double extreme = 0.0;                     // [m] farthest in the present direction
    double direction = 1.0;                   // +1 or -1
    std::array<double, kReversals> turned{};  // [s] when
    std::size_t count = 0;
  };

  bool chatters(Axis& axis, double position) noexcept;
  bool lower(double wanted) noexcept;

  double period_;
  double turn_;            // [m] that makes a reversal
  double floor_;           // [N/m]
  double now_ = 0.0;       // [s]
  double touched_ = -1.0;  // [s] when the lever was last in a wall
  double share_ = 1.0;
  double chattered_ = -1.0;  // [s] when it last did
  int at_floor_ = 0;         // times in a row that there was nothing left to take
  std::array<Axis, 2> axis_{};
};

}  // namespace gearshift
