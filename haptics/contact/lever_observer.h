// Position, velocity and the hand's force, from samples and the forces that the motors gave: what a contact needs
// that acts some samples late.
//
// This work is based on:
// D. G. Luenberger. An Introduction to Observers. 1971
// J. Ackermann. Der Entwurf linearer Regelungssysteme im Zustandsraum. 1972
//
// Each axis is the device's m x'' + b x' + k x = u + w, u of the motors and known, w of the hand and taken as
// constant. All three poles of the error lie at exp(-bandwidth T).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/contact/lever_estimator.h"
#include "haptics/device/haptic_device.h"
#include "haptics/joystick/plant.h"

namespace gearshift {

// Of the estimate's error [1/s]. Faster, and the encoder's counts are heard; slower, and a heavy hand is not understood.
inline double observer_bandwidth(double period) noexcept {
  return std::min(500.0, 1.25 / period);
}

struct AxisEstimate {
  double position = 0.0;  // [m]
  double velocity = 0.0;  // [m/s]
  double hand = 0.0;      // [N]
};

class AxisObserver {
 public:
  AxisObserver(const AxisModel& axis, double bandwidth, double period) noexcept;  // bandwidth [1/s], period [s]

  // One period on, the motors giving `force` [N]: before the sample is known.
  AxisEstimate predict(const AxisEstimate& estimate, double force) const noexcept;
  // With the sample [m] of that instant.
  AxisEstimate correct(AxisEstimate predicted, double position) const noexcept;
  // How much a force held over a period moves its end. [m/N]
  double compliance() const noexcept { return stepper_.step({}, 1.0).position; }

 private:
  AxisStepper stepper_;
  std::array<double, 3> gain_{};  // of the sample, on position, velocity and hand
};

// What the observer knows of the period over which the next command will act.
struct ObservedMotion {
  glm::dvec2 position{0.0};  // [m] at its beginning
  glm::dvec2 end{0.0};       // [m] at its end, if the motors gave nothing; the loop adds what they give beside the wall
  glm::dvec2 compliance{0.0};  // [m/N] how much a force held over it moves that end, per axis
};

class LeverObserver {
 public:
  LeverObserver(const DeviceSpec& spec, double period) noexcept;  // period [s]

  // commanded: the force that was written in the cycle before [N]; skipped: cycles missed since then, in which it was
  // held. Real-time safe.
  ObservedMotion update(const LeverMotion& motion, glm::dvec2 commanded, std::int64_t skipped = 0) noexcept;

 private:
  struct Axis {
    AxisObserver observer;
    AxisEstimate estimate;
  };

  double sent(std::size_t age, int axis) const noexcept;
  void pass_period(glm::dvec2 commanded) noexcept;
  AxisEstimate observe(Axis& axis, int index, const LeverMotion& motion) noexcept;

  std::array<Axis, 2> axis_;
  std::array<glm::dvec2, kMostDelay + 1> sent_{};  // [N] the last commands
  std::size_t newest_ = 0;                         // of them
  std::size_t delay_;
  bool started_ = false;
  int blind_ = 0;  // [cycles] without a fresh sample
};

}  // namespace gearshift
