// Hand, feet, lever, loop and car, run together on a virtual clock.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "app/vehicle/car_load.h"
#include "haptics/device/pushing_hand.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"
#include "tests/app/vehicle/cars.h"

namespace gearshift::test {

using Feet = std::function<haptics::DriverControls(double time)>;

inline haptics::DriverControls clutch_down() {
  haptics::DriverControls feet;
  feet.ignition = true;
  feet.pedals.clutch = 1.0;
  return feet;
}
inline haptics::DriverControls clutch_up(double throttle = 0.0) {
  haptics::DriverControls feet;
  feet.ignition = true;
  feet.pedals.throttle = throttle;
  return feet;
}

inline haptics::SimulatedRunConfig gripped(const haptics::Gate& gate, int gear) {
  haptics::SimulatedRunConfig config;
  config.gate = gate;
  config.start = haptics::rest_position(gate, gear);
  config.haptics.guard.ramp_time = 0.01;
  config.lever.hand = haptics::kGripHand;
  return config;
}

struct CarRun {
  CarRun(const vehicle::CarSpec& spec, const vehicle::CarStart& from, haptics::HandDriver& hand, Feet feet,
         std::uint64_t seed = 1)
      : car(spec),
        gate(gate_of(spec)),
        load(spec, gate, kPaperForce, from, seed),
        run(gripped(gate, from.gear), hand, &load),
        feet_(std::move(feet)) {}

  const haptics::HapticSnapshot& step() {
    run.inputs().controls.write(feet_(run.time()));
    return run.step();
  }
  const vehicle::VehicleState& state() const { return load.state(); }
  double time() const { return run.time(); }

  vehicle::CarSpec car;
  haptics::Gate gate;
  vehicle::CarLoad load;
  haptics::SimulatedRun run;

 private:
  Feet feet_;
};

// A hand that pushes with at most 30 N, which the motors can hold: its spring, 15 N at a ring far from the gear, and
// effort.
inline haptics::ScriptedHandConfig measured_hand(glm::dvec2 start) {
  haptics::ScriptedHandConfig hand = haptics::touring_hand(start);
  hand.effort_limit = 15.0;
  return hand;
}

// A hand that waits for `wait` seconds, and then shifts through `gears`.
inline haptics::ScriptedHand shifting_hand(const haptics::Gate& gate, int from, std::vector<int> gears, double wait,
                                           const haptics::ShiftStyle& style) {
  const glm::dvec2 start = haptics::rest_position(gate, from);
  std::vector<haptics::HandStroke> strokes{{start, wait, 0.0, {}, false, false}};
  for (const haptics::HandStroke& stroke : haptics::shift_strokes(gate, start, gears, style)) strokes.push_back(stroke);
  return {measured_hand(start), std::move(strokes), 0.001};
}

// The same at the default pace.
inline haptics::ScriptedHand shifting_hand(const haptics::Gate& gate, int from, std::vector<int> gears,
                                           double wait = 0.2, double dwell = 0.5) {
  haptics::ShiftStyle style;
  style.dwell_gear = dwell;
  return shifting_hand(gate, from, std::move(gears), wait, style);
}

// A start in `gear` while the car rolls: shaft and engine turn at `shaft_speed` [rad/s], and the road speed corresponds
// to it.
inline vehicle::CarStart rolling_in(const vehicle::CarSpec& car, int gear, double shaft_speed) {
  vehicle::CarStart start;
  start.gear = gear;
  start.road_speed = road_speed_at(car, gear, shaft_speed);
  return start;
}

}  // namespace gearshift::test
