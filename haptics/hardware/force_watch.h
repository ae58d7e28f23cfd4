// Notices a stick that drives otherwise than calibrated, from the motion that follows its forces.
//
// Explanations of the readings compete: the forces act as calibrated, reversed or not at all, and one of several hands
// holds the lever. Each pair is a Kalman filter of position, speed and the hand's wandering force, and predicts every
// reading. A fault is found if a wrong stick with some hand predicts the readings clearly better than a right stick
// with any hand.
//
// A handle of mass m in a hand of mass M moves by (m + M) a = g u, so readings show only g / (m + M). A reversed stick
// (g < 0) shows with every hand; a silent one only against the heaviest hand assumed here. Half the strength cannot be
// noticed, because a hand heavier by m + M looks the same, nor can twice, unless the hand is lighter than the handle.
//
// Some hands are a heavy mass behind a springy grip. Without them, an arm that struck a wall was explained best by a stick
// whose springs act reversed: 6 false alarms in 12 hours, now none.
//
// In hands that it was not tuned with (force_watch_test.cpp), of 144 reversed sticks 135 were off within 20 s, 115 of them
// by this watch, but of 144 silent ones only 14: a hand that rests gives no evidence, and one that is stronger than the
// stick moves it nearly alike with and without forces. So PidLever also asks whether a full force was felt: in 106 of the
// 144. A healthy stick is asked nine times in twelve hours of hands that push until they overpower it. Of 144 sticks
// whose springs alone act reversed, which a springy grip resembles, only 17 were off within 20 s.
//
// This work is based on:
// D. T. Magill. Optimal Adaptive Estimation of Sampled Stochastic Processes. 1965
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/device/haptic_device.h"

namespace gearshift::haptics {

enum class ForceFault : std::uint8_t { none, reversed, silent };

// The forces that the stick is believed to make on one axis: a constant one, and a spring and a damper outside of a
// dead band.
struct AxisForces {
  double constant = 0.0;         // [N]
  double low = 0.0, high = 0.0;  // [m] the spring's dead band
  double stiffness = 0.0;        // [N/m] of the spring
  double damping = 0.0;          // [N s/m] everywhere
  bool operator==(const AxisForces&) const = default;
};
using StickForces = std::array<AxisForces, 2>;  // select, shift

class ForceWatch {
 public:
  // `lag` [s]: from a force's output to the reading that shows it
  ForceWatch(const DeviceSpec& spec, double lag) noexcept;

  // Real-time safe.
  void on_output(const StickForces& forces, std::int64_t time_ns) noexcept;
  void on_reading(glm::dvec2 position, std::int64_t time_ns) noexcept;  // [m]
  // The motors are off: for a stuck sensor, a late command or because a person switched them off. Evidence that no motor
  // acts is kept for when they are on again, because a stick without power is often switched off for another reason first.
  void pause() noexcept;
  void reset() noexcept;

  // The best explained fault. `is_doubtful`: the stick says that it makes no forces. That may not be true, and counts
  // only until its forces were seen.
  ForceFault fault(bool is_doubtful = false) const noexcept;
  // True if it is likely that no motor acts, both having the same power supply: too little for fault().
  bool may_be_silent() const noexcept;
  // [nat] log likelihood of a fault, less that of a stick without fault.
  double evidence(int axis, ForceFault fault) const noexcept;

 private:
  static constexpr std::size_t kExplanations = 4;
  // Rigid and elastic hands, both even numbers, so that the compiler can compute two at once.
  static constexpr std::size_t kRigid = 14, kHands = 20;
  static constexpr std::size_t kStates = 5, kRigidStates = 3;
  using Values = std::array<double, kHands>;  // one for each hand
  struct Estimate {
    std::array<Values, kStates> state{};  // [m] [m/s] [N] of the hand, and [m] [m/s] of an elastic hand's mass
    Values likelihood{};                  // [nat] logarithm, fading
  };
  struct Axis {
    double reach = 0.0;      // [m]
    double max_force = 0.0;  // [N]
    // [1/kg] 1 / mass, [N s/m] and [N/m] of the handle, together with a rigid hand
    Values mobility{}, damping{}, stiffness{};
    std::array<std::array<Values, kStates>, kStates> covariance{};  // only [i][j] with i <= j
    std::array<Estimate, kExplanations> estimate{};
    std::array<double, kExplanations> likelihood{};  // [nat] with the best of all hands
  };
  struct Output {
    StickForces forces;
    std::int64_t time_ns = 0;
  };

  static void place(Axis& axis, double position) noexcept;
  static void predict(Axis& axis, const AxisForces& forces, double seconds) noexcept;
  void correct(Axis& axis, double position, double speed, double seconds) const noexcept;
  const Output& output_at(std::int64_t time_ns) const noexcept;

  std::array<Axis, 2> axis_;
  double count_variance_;  // [m^2] of positions, from their resolution
  std::int64_t lag_ns_;
  std::array<Output, 128> outputs_{};  // a ring
  std::size_t newest_ = 0;
  bool has_reading_ = false;
  bool drives_ = false;          // its forces were seen
  std::int64_t driving_ns_ = 0;  // [ns] when they were seen last
  glm::dvec2 position_{0.0};     // newest
  std::int64_t time_ns_ = 0;     // of the newest reading
};

}  // namespace gearshift::haptics
