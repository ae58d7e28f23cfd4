// A trainer for tests, and a person who leads it through gears.
#pragma once

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/trainer/trainer.h"
#include "haptics/loop/shift_script.h"
#include "tests/support/gates.h"

namespace gearshift {

inline TrainerConfig trainer_config(TrainerClock clock, const std::string& gate = "paper") {
  TrainerConfig config;
  config.layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/" + gate + ".toml");
  config.clock = clock;
  return config;
}

inline TrainerConfig hatchback(TrainerClock clock) {
  TrainerConfig config = trainer_config(clock, "five_speed_r_right_down");
  config.car = read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml");
  return config;
}

inline const std::vector<int> kPaperTour{1, 2, 3, 4, 5, kReverseGear};

// A hand at 60 frames a second: from wherever it is straight to the neutral line, along it by way of the neutral
// column, and into the slot, 20 mm beyond the gear's rest. Knob and ring are held for reverse.
// `frame` lets a frame pass.
class LeadingPerson {
 public:
  static constexpr double kFrame = 1.0 / 60.0;  // [s]

  LeadingPerson(Trainer& trainer, std::function<void()> frame)
      : trainer_(trainer), frame_(std::move(frame)), at_(rest_position(trainer.gate(), kNeutralGear)) {}

  void go(glm::dvec2 to) {
    constexpr double kSpeed = 0.25;  // [m/s]
    const glm::dvec2 from = at_;
    const int frames = static_cast<int>(std::ceil(std::hypot(to.x - from.x, to.y - from.y) / (kSpeed * kFrame)));
    for (int i = 1; i <= frames; ++i) lead(from + (to - from) * (static_cast<double>(i) / frames));
  }

  // Frames in which the hand stays.
  void wait(int frames) {
    for (int i = 0; i < frames; ++i) lead(at_);
  }

  void shift_to(int gear) {
    const double neutral = rest_position(trainer_.gate(), kNeutralGear).x;
    const glm::dvec2 rest = rest_position(trainer_.gate(), gear);
    const double against_return = rest.x == neutral ? 0.0 : std::copysign(0.005, rest.x - neutral);
    go({at_.x, 0.0});
    wait(6);
    go({neutral, 0.0});
    wait(6);
    holds_ = gear == kReverseGear;
    go({rest.x + against_return, 0.0});
    wait(6);
    go({rest.x + against_return, rest.y + std::copysign(0.02, rest.y)});
    wait(12);
  }

 private:
  void lead(glm::dvec2 to) {
    at_ = to;
    HandTarget target;
    target.position = to;
    target.pressed_down = target.lifted = holds_;
    trainer_.set_hand(target);
    frame_();
  }

  Trainer& trainer_;
  std::function<void()> frame_;
  glm::dvec2 at_;
  bool holds_ = false;
};

// In a person's place: through every gear of the gate, from neutral.
inline ScriptedHand tour_of(const Gate& gate, double period = 1e-3) {
  const glm::dvec2 start = rest_position(gate, kNeutralGear);
  return {touring_hand(start), shift_strokes(gate, start, tour_order(gate)), period};
}
inline SelfDriver touring_driver(const Gate& gate, double period = 1e-3) {
  const auto hand = std::make_shared<ScriptedHand>(tour_of(gate, period));
  return [hand, began = std::make_shared<double>(-1.0)](const DriveSample& now) {
    if (*began < 0.0) *began = now.time();
    DriverAction action;
    action.hand = hand->next(now.time() - *began, now.lever.lever);
    return action;
  };
}

inline void sleep_ms(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// Until it holds, at most ten seconds.
template <class Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) sleep_ms(5);
  return condition();
}

// The gears among the events, in order.
inline void add_gears(const std::vector<HapticEvent>& events, std::vector<int>& gears) {
  for (const HapticEvent& event : events)
    if (event.kind == EventKind::gear_engaged) gears.push_back(static_cast<int>(event.value));
}

}  // namespace gearshift
