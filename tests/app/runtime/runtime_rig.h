// A runtime for tests, and a simulated user who moves the lever through the gears.
#pragma once

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/runtime/runtime.h"
#include "haptics/loop/shift_script.h"
#include "tests/support/gates.h"

namespace gearshift::test {

inline runtime::RuntimeConfig runtime_config(runtime::RuntimeClock clock, const std::string& gate = "paper") {
  runtime::RuntimeConfig config;
  config.layout = haptics::read_gate_layout(GEARSHIFT_ASSETS "/gates/" + gate + ".toml");
  config.clock = clock;
  return config;
}

inline runtime::RuntimeConfig hatchback(runtime::RuntimeClock clock) {
  runtime::RuntimeConfig config = runtime_config(clock, "five_speed_r_right_down");
  config.car = vehicle::read_car(GEARSHIFT_ASSETS "/cars/hatchback.toml");
  return config;
}

inline const std::vector<int> kPaperTour{1, 2, 3, 4, 5, haptics::kReverseGear};

// A hand that moves at 60 frames per second: straight to the neutral line, along this line through the neutral column
// to the slot's column, and into the slot, 20 mm beyond the gear's rest position. For reverse, it holds the knob down
// and the ring lifted. `frame` is called after each hand position and must advance the runtime by one frame.
class LeadingPerson {
 public:
  static constexpr double kFrame = 1.0 / 60.0;  // [s]

  LeadingPerson(runtime::Runtime& runtime, std::function<void()> frame)
      : runtime_(runtime),
        frame_(std::move(frame)),
        at_(haptics::rest_position(runtime.gate(), haptics::kNeutralGear)) {}

  void go(glm::dvec2 to) {
    constexpr double kSpeed = 0.25;  // [m/s]
    const glm::dvec2 from = at_;
    const int frames = static_cast<int>(std::ceil(std::hypot(to.x - from.x, to.y - from.y) / (kSpeed * kFrame)));
    for (int i = 1; i <= frames; ++i) lead(from + (to - from) * (static_cast<double>(i) / frames));
  }

  // Holds the hand still for `frames` frames.
  void wait(int frames) {
    for (int i = 0; i < frames; ++i) lead(at_);
  }

  void shift_to(int gear) {
    const double neutral = haptics::rest_position(runtime_.gate(), haptics::kNeutralGear).x;
    const glm::dvec2 rest = haptics::rest_position(runtime_.gate(), gear);
    const double against_return = rest.x == neutral ? 0.0 : std::copysign(0.005, rest.x - neutral);
    go({at_.x, 0.0});
    wait(6);
    go({neutral, 0.0});
    wait(6);
    holds_ = gear == haptics::kReverseGear;
    go({rest.x + against_return, 0.0});
    wait(6);
    go({rest.x + against_return, rest.y + std::copysign(0.02, rest.y)});
    wait(12);
  }

 private:
  void lead(glm::dvec2 to) {
    at_ = to;
    haptics::HandTarget target;
    target.position = to;
    target.pressed_down = target.lifted = holds_;
    runtime_.set_hand(target);
    frame_();
  }

  runtime::Runtime& runtime_;
  std::function<void()> frame_;
  glm::dvec2 at_;
  bool holds_ = false;
};

// A scripted hand that shifts from neutral through every gear of the gate.
inline haptics::ScriptedHand tour_of(const haptics::Gate& gate, double period = 1e-3) {
  const glm::dvec2 start = haptics::rest_position(gate, haptics::kNeutralGear);
  return {haptics::touring_hand(start), haptics::shift_strokes(gate, start, haptics::tour_order(gate)), period};
}
inline runtime::DriverFunction touring_driver(const haptics::Gate& gate, double period = 1e-3) {
  const auto hand = std::make_shared<haptics::ScriptedHand>(tour_of(gate, period));
  return [hand, began = std::make_shared<double>(-1.0)](const vehicle::DriveSample& now) {
    if (*began < 0.0) *began = now.time();
    vehicle::DriverAction action;
    action.hand = hand->next(now.time() - *began, now.lever.lever);
    return action;
  };
}

inline void sleep_ms(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// Polls until the condition holds, for at most ten seconds.
template <class Condition>
bool becomes_true(const Condition& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) sleep_ms(5);
  return condition();
}

// Appends to `gears` the gears that were engaged in `events`, in order.
inline void add_gears(const std::vector<haptics::HapticEvent>& events, std::vector<int>& gears) {
  for (const haptics::HapticEvent& event : events)
    if (event.kind == haptics::EventKind::gear_engaged) gears.push_back(static_cast<int>(event.value));
}

}  // namespace gearshift::test
