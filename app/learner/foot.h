// A foot on a pedal, or a hand on the hand brake: it goes to its goal at a speed, and is never quite still on the way.
#pragma once

#include <cstdint>

#include "haptics/device/gaussian_noise.h"

namespace gearshift {

class Foot {
 public:
  // noise: standard deviation of a pedal held in between [1]; at rest at either end there is none.
  Foot(double noise, std::uint64_t seed) : noise_(noise), chance_(seed) {}

  void place(double value) noexcept { value_ = goal_ = value; }
  // goal [1] 0 to 1; rate [1/s] > 0.
  void go(double goal, double rate) noexcept;
  void hold() noexcept { goal_ = value_; }
  double step(double dt) noexcept;  // [1] 0 to 1: the pedal now

  double value() const noexcept { return value_; }  // without the noise
  double goal() const noexcept { return goal_; }

 private:
  double noise_;
  GaussianNoise chance_;
  double value_ = 0.0, goal_ = 0.0, rate_ = 1.0;
  double tremor_ = 0.0;
};

}  // namespace gearshift
