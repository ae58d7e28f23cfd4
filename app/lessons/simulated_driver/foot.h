// A foot on a pedal, or a hand on the handbrake: moves to a goal at a given rate, with tremor on the way.
#pragma once

#include <cstdint>

#include "haptics/device/gaussian_noise.h"

namespace gearshift::lessons {

class Foot {
 public:
  // `noise`: standard deviation [1] of the pedal's tremor. A pedal that is fully up or fully down has no tremor.
  Foot(double noise, std::uint64_t seed) : noise_(noise), random_(seed) {}

  void place(double value) noexcept { value_ = goal_ = value; }
  // `goal`: 0 to 1. `rate` [1/s]: > 0.
  void move_to(double goal, double rate) noexcept;
  void hold() noexcept { goal_ = value_; }
  double step(double dt) noexcept;  // returns the pedal position [1], 0 to 1

  double value() const noexcept { return value_; }  // without tremor
  double goal() const noexcept { return goal_; }

 private:
  double noise_;
  haptics::GaussianNoise random_;
  double value_ = 0.0, goal_ = 0.0, rate_ = 1.0;
  double tremor_ = 0.0;
  double dt_ = -1.0, keep_ = 0.0, spread_ = 0.0;  // [s] last step; what it keeps of the tremor and what it adds
};

}  // namespace gearshift::lessons
