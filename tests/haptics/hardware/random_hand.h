// A hand that does what people do: reaches for gears, holds, pushes, strikes, trembles, lets go and grips again. Its
// mass touches the lever through skin, so that it can leave it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

// A hand with which nothing was tuned: its muscles, reflexes and grip are drawn at random, and it feels the lever late,
// which no hand that the watch assumes does.
class ReflexHand final : public haptics::HandDriver {
 public:
  ReflexHand(unsigned seed, std::vector<glm::dvec2> places) : chance_(seed), places_(std::move(places)) {
    mass_ = std::exp(between(std::log(0.1), std::log(3.0)));
    stiffness_ = between(60.0, 1500.0);
    damping_ = 2.0 * between(0.2, 1.0) * std::sqrt(stiffness_ * mass_);
    grip_stiffness_ = between(1500.0, 8000.0);
    // The push acts 1.5 periods late on average, as a damping of -1.5 k T, which no skin has.
    grip_damping_ = between(2.0, 12.0) + 1.5 * kPeriod * grip_stiffness_;
    reflex_ = between(0.0, 0.3) * stiffness_;
    reflex_ms_ = static_cast<std::size_t>(between(30.0, 90.0));
    reaction_ = between(0.15, 0.3);
    tremor_ = between(0.0, 0.4);
    for (double& frequency : tremor_frequency_) frequency = between(8.0, 12.0);
  }

  haptics::HandTarget next(double time, glm::dvec2 lever) noexcept override {
    if (!started_) start(lever);
    const glm::dvec2 speed = (lever - std::exchange(last_, lever)) / kPeriod;
    if (time >= until_) choose(time, lever, speed);
    haptics::HandTarget target;
    if (!holds_) return target;
    const double s = std::clamp((time - since_) / duration_, 0.0, 1.0);
    aim_ = from_ + (to_ - from_) * (s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
    const glm::dvec2 felt = std::exchange(error_[at_], aim_ - hand_);  // as it was `reflex_ms_` ago
    at_ = (at_ + 1) % reflex_ms_;
    // Where the hand does not arrive, it pushes harder after its reaction time.
    const bool pushes = time > since_ + duration_ + reaction_;
    effort_ += kPeriod / kMuscleTime * ((pushes ? push_ : glm::dvec2(0.0)) - effort_);
    tension_ += kPeriod / kMuscleTime * (wanted_tension_ - tension_);
    const glm::dvec2 will = stiffness_ * tension_ * (aim_ - hand_) - damping_ * hand_speed_ + reflex_ * felt + effort_ +
                            tremor_ * trembling(time);
    const glm::dvec2 grip = grip_stiffness_ * (hand_ - lever) + grip_damping_ * (hand_speed_ - speed);
    hand_speed_ += kPeriod / mass_ * (will - grip);
    hand_ += kPeriod * hand_speed_;
    target.push = grip;
    return target;
  }

 private:
  static constexpr double kPeriod = 0.001;     // [s]
  static constexpr double kMuscleTime = 0.05;  // [s] in which a muscle's force follows what is wanted

  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(chance_); }

  void start(glm::dvec2 lever) {
    started_ = true;
    grasp(lever, glm::dvec2(0.0));
    last_ = lever;
  }

  void grasp(glm::dvec2 lever, glm::dvec2 speed) {
    holds_ = true;
    hand_ = aim_ = from_ = to_ = lever;
    hand_speed_ = speed;
    effort_ = glm::dvec2(0.0);
    error_.fill(glm::dvec2(0.0));
  }

  glm::dvec2 trembling(double time) const {
    glm::dvec2 sum{0.0};
    for (std::size_t i = 0; i < tremor_frequency_.size(); ++i)
      sum[static_cast<int>(i % 2)] += std::sin(2.0 * std::numbers::pi * tremor_frequency_[i] * time);
    return sum;
  }

  void choose(double time, glm::dvec2 lever, glm::dvec2 speed) {
    if (holds_ && chance_() % 8 == 0) {  // lets go
      holds_ = false;
      until_ = time + between(0.3, 2.0);
      return;
    }
    if (!holds_) grasp(lever, speed);
    from_ = aim_;
    to_ = places_[chance_() % places_.size()] + glm::dvec2(between(-0.006, 0.006), between(-0.006, 0.006));
    since_ = time;
    duration_ = glm::length(to_ - from_) / between(0.04, 0.8) + between(0.1, 0.3);
    until_ = time + duration_ + between(0.0, 3.0);
    wanted_tension_ = between(0.5, 2.0);
    push_ = glm::length(to_ - from_) > 0.0 ? between(0.0, 25.0) * glm::normalize(to_ - from_) : glm::dvec2(0.0);
  }

  std::mt19937 chance_;
  std::vector<glm::dvec2> places_;
  double mass_, damping_, stiffness_;         // [kg] [N s/m] [N/m] of arm and muscles
  double grip_damping_, grip_stiffness_;      // [N s/m] [N/m]
  double reflex_, reaction_, tremor_;         // [N/m] [s] [N]
  std::size_t reflex_ms_;                     // [ms] delay of the reflex
  std::array<double, 4> tremor_frequency_{};  // [Hz] two per axis, so that the tremor swells and fades
  std::array<glm::dvec2, 90> error_{};        // [m] a ring
  std::size_t at_ = 0;
  glm::dvec2 hand_{0.0}, hand_speed_{0.0}, aim_{0.0}, from_{0.0}, to_{0.0}, push_{0.0}, effort_{0.0}, last_{0.0};
  double tension_ = 1.0, wanted_tension_ = 1.0, since_ = 0.0, duration_ = 1.0, until_ = 0.0;  // [1] [s]
  bool holds_ = true, started_ = false;
};

}  // namespace gearshift::test
