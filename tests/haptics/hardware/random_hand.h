// A hand that does what people do: reaches for gears, holds, pushes, strikes, trembles, lets go and grips again. Its
// mass touches the lever through skin, so that it can leave it.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "haptics/device/hand.h"

namespace gearshift::test {

class RandomHand final : public haptics::HandDriver {
 public:
  RandomHand(unsigned seed, std::vector<glm::dvec2> places) : chance_(seed), places_(std::move(places)) { change(); }

  haptics::HandTarget next(double time, glm::dvec2 lever) noexcept override {
    if (!started_) hand_ = from_ = to_ = last_ = lever;
    started_ = true;
    const glm::dvec2 speed = (lever - std::exchange(last_, lever)) / kPeriod;
    if (time >= until_) choose(time, lever, speed);
    haptics::HandTarget target;
    if (!holds_) return target;
    const double s = std::clamp((time - since_) / duration_, 0.0, 1.0);
    const glm::dvec2 aim = from_ + (to_ - from_) * (s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
    const double phase = 2.0 * std::numbers::pi * 9.0 * time;  // of the tremor
    const glm::dvec2 will = stiffness_ * (aim - hand_) - damping_ * hand_speed_ +
                            push_ * std::clamp((time - pushed_at_) / rise_, 0.0, 1.0) +
                            tremor_ * glm::dvec2(std::sin(phase), std::cos(1.1 * phase));
    const auto skin = [&] { return kSkinStiffness * (hand_ - lever) + kSkinDamping * (hand_speed_ - speed); };
    hand_speed_ += kPeriod / mass_ * (will - skin());
    hand_ += kPeriod * hand_speed_;
    target.push = skin();
    return target;
  }

 private:
  static constexpr double kPeriod = 0.001;                              // [s]
  static constexpr double kSkinStiffness = 4000.0, kSkinDamping = 4.0;  // [N/m] [N s/m]

  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(chance_); }

  void change() {  // another hand
    mass_ = std::exp(between(std::log(0.02), std::log(2.5)));
    stiffness_ = std::clamp(mass_ * between(800.0, 5000.0), 100.0, 2000.0);
    damping_ = 2.0 * between(0.15, 0.8) * std::sqrt(stiffness_ * mass_);
    tremor_ = between(0.0, 0.3);
  }

  void choose(double time, glm::dvec2 lever, glm::dvec2 speed) {
    const auto deed = chance_() % 10;
    from_ = to_;
    until_ = time + between(0.2, 1.2);
    push_ = glm::dvec2(0.0);
    if (deed < 2) {
      holds_ = false;
      return;
    }
    if (!std::exchange(holds_, true)) {
      if (chance_() % 3 == 0) change();
      hand_ = from_ = to_ = lever;
      hand_speed_ = speed;
    }
    if (deed < 7) {  // reaches
      to_ = places_[chance_() % places_.size()] + glm::dvec2(between(-0.003, 0.003), between(-0.003, 0.003));
      since_ = time;
      duration_ = glm::length(to_ - from_) / between(0.05, 0.6) + 0.1;
      until_ = time + duration_ + between(0.0, 0.6);
    } else if (deed < 9) {  // pushes; one of five pushes is a strike
      const double angle = between(0.0, 2.0 * std::numbers::pi);
      push_ = between(4.0, 30.0) * glm::dvec2(std::cos(angle), std::sin(angle));
      rise_ = between(0.0, 1.0) < 0.2 ? kPeriod : between(0.03, 0.15);
      pushed_at_ = time;
    }
  }

  std::mt19937 chance_;
  std::vector<glm::dvec2> places_;
  double mass_ = 0.0, damping_ = 0.0, stiffness_ = 0.0, tremor_ = 0.0;  // [kg] [N s/m] [N/m] [N]
  glm::dvec2 hand_{0.0}, hand_speed_{0.0}, from_{0.0}, to_{0.0}, push_{0.0}, last_{0.0};
  double since_ = 0.0, duration_ = 1.0, until_ = 0.0, pushed_at_ = 0.0, rise_ = 1.0;  // [s]
  bool holds_ = true, started_ = false;
};

}  // namespace gearshift::test
