// This work is based on:
// Rodger J. Elble. Characteristics of physiologic tremor in young and elderly adults. Clinical Neurophysiology 114. 2003
//
// Softens a wall on which the lever chatters. Chatter is detected from the motion, so effects that the stability model
// does not contain are covered too.
//
// A hand does not reverse a lever eight times in 0.35 s (10 Hz), but a wall that is too stiff for its device does. A hand
// also trembles, at 8 to 12 Hz (Elble 2003) and by less than a millimetre. So reversals that small count only if eight of
// them fall within 0.28 s (12.5 Hz). Each detection
// removes a quarter of the wall's stiffness, down to 0.3 m / tau^2, with the device's mass m, tau = (delay + 1) T and the
// loop's period T. This stiffness is stable if mass and delay are as specified. If the lever still chatters at this
// stiffness, mass or delay must differ from the specification, so the stiffness is halved until the lever is still. The
// reduction lasts until the loop is armed again or the wall is tuned. A bounce that decays costs little or no stiffness.
// Chatter that persists at 1/64 of the stiffness is not caused by the wall.
//
// The load may vibrate the lever on purpose, for example to simulate a stalling engine. The lever then reverses as
// often as the vibration force and moves no further than this force can move it. Such reversals are ignored: a softer
// wall would not calm them, and the lever needs its walls. Reversals that are more frequent or wider than the vibration
// explains count as usual. A swing does not count either if no wall of this stiffness and damping can sustain it, or if it
// dies away by itself: if one of the eight widths is less than half of an earlier one. A hand that lets go or hits a wall
// may strike a dying swing again, but not for long: after 24 reversals that are still half as wide as the first ones, it is
// chatter, however uneven.
#pragma once

#include <array>
#include <cstddef>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"

namespace gearshift::haptics {

class ReversalLimiter {
 public:
  ReversalLimiter(const DeviceSpec& spec, double period) noexcept;  // period [s]

  void reset() noexcept;  // full stiffness again

  // Call once per cycle. `position`: accepted position of the lever [m]. `in_contact`: true if the lever is pressed
  // into a wall. `wanted`, `damping`: of this wall before softening [N/m], [N s/m]. `vibration`: force with which the load
  // vibrates the lever, independent of the lever's motion [N]. Returns true if stiffness_fraction() or is_exhausted()
  // has changed. Real-time safe.
  bool update(glm::dvec2 position, bool in_contact, double wanted, double damping, glm::dvec2 vibration) noexcept;

  double stiffness_fraction() const noexcept { return fraction_; }  // [1] fraction of the wanted stiffness to use
  bool is_exhausted() const noexcept { return is_exhausted_; }      // chatter persists despite softening

 private:
  static constexpr std::size_t kReversals = 8;

  // Detects reversals of a value. A reversal counts once the value has moved back from its extreme by `back`.
  struct Swing {
    bool reverses(double value, double back) noexcept;

    double farthest = 0.0;   // extreme value since the last reversal
    double direction = 1.0;  // +1 or -1
    double last_turn = 0.0;  // value at the last reversal
    double width = 0.0;      // distance between the last two reversals
  };

  struct Axis {
    Swing lever;                                       // [m]
    int pending_turns = 0;                             // vibration reversals not yet matched by a lever reversal
    std::array<double, kReversals> reversal_times{};   // [s] times of lever reversals not explained by the vibration
    std::array<double, kReversals> reversal_widths{};  // [m] their distances from the reversal before
    std::size_t count = 0;
    std::size_t lasted = 0;     // number of reversals since they became too fast for a hand
    double first_width = 0.0;   // [m] of the widest reversal then
    double narrow_time = -1.0;  // [s] time of the last reversal as narrow as a tremor
  };

  void track_vibration(glm::dvec2 vibration) noexcept;
  bool is_forced_turn(Axis& axis) noexcept;
  bool detect_chatter(Axis& axis, double position, double wanted, double damping) noexcept;
  static double widest(const Axis& axis) noexcept;
  static bool is_dying(const Axis& axis) noexcept;
  bool soften(double wanted) noexcept;

  double period_;
  double reversal_step_;        // [m] motion back from an extreme that counts as a reversal
  double damping_;              // [N s/m] damping of the bare lever
  double floor_;                // [N/m] stable if the device's mass and delay are as specified
  double time_ = 0.0;           // [s]
  double last_contact_ = -1.0;  // [s] time when the lever was last in a wall
  double last_chatter_ = -1.0;  // [s] time when chatter was last detected
  int floor_count_ = 0;         // consecutive detections of chatter at or below the stiffness floor
  double fraction_ = 1.0;
  bool is_exhausted_ = false;
  std::array<Axis, 2> axis_{};
  std::array<Swing, 2> vibration_{};   // [N]
  double last_vibration_turn_ = -1.0;  // [s] time of the last reversal of the vibration
  double max_forced_swing_ = 0.0;      // [m] widest swing that the vibration can cause if all walls are passive
};

}  // namespace gearshift::haptics
