// Softens a wall on which the lever chatters: what no model foresaw is seen in the motion.
//
// A hand does not reverse a lever six times in a quarter of a second; a wall that is too stiff for its device does.
// Each time, a quarter of the wall's stiffness is taken, down to 0.3 m / tau^2, which would hold if mass and delay were
// what the device says. Where it chatters on all the same they are not: then half of it, and again, until it is still.
// It stays there until the loop is armed anew or the wall is tuned. A bounce that dies away by itself takes little or
// nothing. What chatters on at 1/64 is no wall's doing.
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

  double share() const noexcept { return share_; }        // [1] of the wanted stiffness to be used
  bool exhausted() const noexcept { return exhausted_; }  // softening does not help

 private:
  static constexpr std::size_t kReversals = 6;

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
  double turn_;              // [m] that makes a reversal
  double floor_;             // [N/m] that would hold if the device were what it says
  double now_ = 0.0;         // [s]
  double touched_ = -1.0;    // [s] when the lever was last in a wall
  double chattered_ = -1.0;  // [s] when it last did
  int at_floor_ = 0;         // times in a row that it chattered at the floor or below
  double share_ = 1.0;
  bool exhausted_ = false;
  std::array<Axis, 2> axis_{};
};

}  // namespace gearshift
