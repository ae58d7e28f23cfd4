// This work is based on:
// Rodger J. Elble. Characteristics of physiologic tremor in young and elderly adults. Clinical Neurophysiology 114. 2003
//
// Softens a wall on which the lever chatters. It detects chatter from the motion, so it also covers what the stability
// model does not.
//
// A hand does not reverse a lever six times in a quarter of a second; a wall that is too stiff for its device does. A
// hand does tremble, at 8 to 12 Hz (Elble 2003), by less than a millimetre; so such small reversals count only if they
// fall within a fifth of a second. Each detection removes a quarter of the wall's stiffness, down to 0.3 m / tau^2,
// which is stable if the device's mass m and delay are as specified (tau = (delay + 1) T). If the lever still chatters
// there, they are not as specified, and the stiffness is halved until the lever is still. The reduction lasts until the
// loop is armed again or the wall is tuned. A bounce that decays costs little or no stiffness. Chatter that persists at
// 1/64 of the stiffness is not caused by the wall.
//
// The load may vibrate the lever on purpose, for example a stalling engine. The lever then reverses as often as that
// force and moves no further than the force can move it; such reversals are ignored, because softening would not calm
// them and would take away walls that the lever needs. Reversals that are more frequent or wider count as usual.
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

  // Call once per cycle. position: accepted position [m]; in_contact: the lever is pressed into a wall; wanted: that
  // wall's stiffness before softening [N/m]; vibration: force by which the load vibrates the lever, independent of its
  // motion [N]. Returns true if stiffness_fraction() or is_exhausted() has changed. Real-time safe.
  bool update(glm::dvec2 position, bool in_contact, double wanted, glm::dvec2 vibration) noexcept;

  double stiffness_fraction() const noexcept { return fraction_; }  // [1] fraction of the wanted stiffness to use
  bool is_exhausted() const noexcept { return is_exhausted_; }      // softening does not help

 private:
  static constexpr std::size_t kReversals = 6;

  // Detects reversals of a value: it has reversed once it has come back from its extreme by `back`.
  struct Swing {
    bool reverses(double value, double back) noexcept;

    double farthest = 0.0;   // extreme in the present direction
    double direction = 1.0;  // +1 or -1
    double last_turn = 0.0;  // value at the last reversal
    double width = 0.0;      // distance between the last two reversals
  };

  struct Axis {
    Swing lever;                                      // [m]
    int pending_turns = 0;                            // vibration reversals not yet matched by a reversal of the lever
    std::array<double, kReversals> reversal_times{};  // [s] times of lever reversals not caused by the vibration
    std::size_t count = 0;
    double narrow_time = -1.0;  // [s] time of the last reversal no wider than a tremor
  };

  void track_vibration(glm::dvec2 vibration) noexcept;
  bool is_forced_turn(Axis& axis) noexcept;
  bool detect_chatter(Axis& axis, double position) noexcept;
  bool soften(double wanted) noexcept;

  double period_;
  double reversal_step_;        // [m] motion back from an extreme that makes a reversal
  double damping_;              // [N s/m] damping of the bare lever
  double floor_;                // [N/m] stiffness that is stable if the device's mass and delay are as specified
  double time_ = 0.0;           // [s]
  double last_contact_ = -1.0;  // [s] when the lever was last in a wall
  double last_chatter_ = -1.0;  // [s] when chatter was last detected
  int floor_count_ = 0;         // consecutive detections at the floor or below
  double fraction_ = 1.0;
  bool is_exhausted_ = false;
  std::array<Axis, 2> axis_{};
  std::array<Swing, 2> vibration_{};   // [N]
  double last_vibration_turn_ = -1.0;  // [s] time of the last reversal of the vibration
  double max_forced_swing_ = 0.0;      // [m] widest swing that the vibration can cause while the walls are passive
};

}  // namespace gearshift::haptics
