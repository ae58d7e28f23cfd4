// This work is based on:
// Rodger J. Elble. Characteristics of physiologic tremor in young and elderly adults. Clinical Neurophysiology 114. 2003
//
// Softens a wall on which the lever chatters: what no model foresaw is seen in the motion.
//
// A hand does not reverse a lever six times in a quarter of a second; a wall that is too stiff for its device does. But
// it trembles, at 8 to 12 Hz (Elble 2003), by less than a millimetre: so little counts in a fifth of a second only.
// Each time, a quarter of the wall's stiffness is taken, down to 0.3 m / tau^2, which would hold if mass and delay were
// what the device says. Where it chatters on all the same they are not: then half of it, and again, until it is still.
// It stays there until the loop is armed anew or the wall is tuned. A bounce that dies away by itself takes little or
// nothing. What chatters on at 1/64 is no wall's doing.
//
// A world may shake the lever too, as a dying engine does. A lever that is shaken turns as often as the force that
// shakes it, and goes no further than that force can move it: such a turn is not the wall's. Softening would not calm it,
// and take the walls from a lever that needs them. What turns oftener, or swings wider, is counted as ever.
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
  // is wanted of that wall [N/m], and the force by which the world shakes the lever: no function of the lever [N]. True
  // when share() or exhausted() has just changed. Real-time safe.
  bool update(glm::dvec2 position, bool touches, double wanted, glm::dvec2 shake) noexcept;

  double share() const noexcept { return share_; }        // [1] of the wanted stiffness to be used
  bool exhausted() const noexcept { return exhausted_; }  // softening does not help

 private:
  static constexpr std::size_t kReversals = 6;

  // Something that goes up and down. It has turned once it has come back from its farthest by `back`.
  struct Swing {
    bool turns(double value, double back) noexcept;

    double farthest = 0.0;   // in the present direction
    double direction = 1.0;  // +1 or -1
    double turned_at = 0.0;  // where it turned last
    double width = 0.0;      // from the turn before to that one
  };

  struct Axis {
    Swing lever;                              // [m]
    int shakes = 0;                           // turns of the shake that no turn of the lever has answered yet
    std::array<double, kReversals> turned{};  // [s] when the lever turned of itself
    std::size_t count = 0;
    double narrow = -1.0;  // [s] when it last turned after no more than a tremor
  };

  void watch_shake(glm::dvec2 shake) noexcept;
  bool is_shaken(Axis& axis) noexcept;
  bool chatters(Axis& axis, double position) noexcept;
  bool lower(double wanted) noexcept;

  double period_;
  double turn_;              // [m] that makes a reversal
  double damping_;           // [N s/m] of the bare lever
  double floor_;             // [N/m] that would hold if the device were what it says
  double now_ = 0.0;         // [s]
  double touched_ = -1.0;    // [s] when the lever was last in a wall
  double chattered_ = -1.0;  // [s] when it last did
  int at_floor_ = 0;         // times in a row that it chattered at the floor or below
  double share_ = 1.0;
  bool exhausted_ = false;
  std::array<Axis, 2> axis_{};
  std::array<Swing, 2> shake_{};  // [N]
  double shaken_ = -1.0;          // [s] when it turned last
  double shaken_by_ = 0.0;        // [m] the most by which that turn of it moves a lever whose walls give no energy
};

}  // namespace gearshift
