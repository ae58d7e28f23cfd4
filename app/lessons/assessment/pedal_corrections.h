// How unsteady the feet are: travel of the pedals in small swings to and fro.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "haptics/loop/lever_load.h"

namespace gearshift::lessons {

// A swing is the way between two turns of a pedal. Swings of more than kMaxSwing are strokes, which belong to driving;
// smaller ones are corrections or an unsteady foot. Only pedals that are partly pressed count, in travel and in time.
class PedalCorrections {
 public:
  static constexpr double kMinSwing = 0.01;    // [1] of pedal travel: more than the noise of a potentiometer
  static constexpr double kMaxSwing = 0.15;    // [1] engineering value
  static constexpr double kMinPressed = 0.02;  // [1] a pedal within this distance of its ends rests
  static constexpr double kMinTime = 0.5;      // [s] a shorter time tells nothing

  // `dt` [s]: time since the last call. Values that are not finite are skipped.
  void add(const haptics::Pedals& pedals, double dt) noexcept {
    const double now[] = {pedals.throttle, pedals.brake, pedals.clutch};
    for (std::size_t i = 0; i < feet_.size(); ++i)
      if (std::isfinite(now[i])) add(feet_[i], now[i], dt);
  }

  // Travel in small swings per second [1/s]; empty if pedals were hardly ever partly pressed.
  std::optional<double> rate() const noexcept {
    return time_ < kMinTime ? std::nullopt : std::optional(travel_ / time_);
  }

 private:
  struct Foot {
    double turn = 0.0;     // [1] where the pedal last turned
    double extreme = 0.0;  // [1] farthest since then
    bool rises = true;
  };

  void add(Foot& foot, double pedal, double dt) noexcept {
    const bool is_partly_pressed = pedal > kMinPressed && pedal < 1.0 - kMinPressed;
    if (is_partly_pressed) time_ += dt;
    foot.extreme = foot.rises ? std::max(foot.extreme, pedal) : std::min(foot.extreme, pedal);
    if (std::abs(pedal - foot.extreme) < kMinSwing) return;
    const double swing = std::abs(foot.extreme - foot.turn);
    if (swing < kMaxSwing && is_partly_pressed) travel_ += swing;
    foot = {foot.extreme, pedal, !foot.rises};
  }

  std::array<Foot, 3> feet_{};
  double travel_ = 0.0;  // [1]
  double time_ = 0.0;    // [s]
};

}  // namespace gearshift::lessons
