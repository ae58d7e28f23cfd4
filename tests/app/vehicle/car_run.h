// Hand, feet, lever, loop and car on a virtual clock.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "app/vehicle/car_world.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/loop/shift_script.h"
#include "haptics/loop/simulated_run.h"
#include "tests/app/vehicle/cars.h"
#include "tests/support/hands.h"

namespace gearshift {

using Feet = std::function<DriverControls(double time)>;

inline DriverControls clutch_down() {
  DriverControls feet;
  feet.ignition = true;
  feet.clutch = 1.0;
  return feet;
}
inline DriverControls clutch_up(double throttle = 0.0) {
  DriverControls feet;
  feet.ignition = true;
  feet.throttle = throttle;
  return feet;
}

inline SimulatedRunConfig gripped(const Gate& gate, int gear) {
  SimulatedRunConfig config;
  config.gate = gate;
  config.start = rest_position(gate, gear);
  config.haptics.guard.ramp_time = 0.01;
  config.lever.hand = kGripHand;
  return config;
}

struct CarRun {
  CarRun(const CarSpec& spec, const CarStart& from, HandDriver& hand, Feet feet, std::uint64_t seed = 1)
      : car(spec),
        gate(gate_of(spec)),
        world(spec, gate, kPaperForce, from, seed),
        run(gripped(gate, from.gear), hand, &world),
        feet_(std::move(feet)) {}

  const HapticSnapshot& step() {
    run.channels().controls.write(feet_(run.time()));
    return run.step();
  }
  const VehicleState& state() const { return world.state(); }
  double time() const { return run.time(); }

  CarSpec car;
  Gate gate;
  CarWorld world;
  SimulatedRun run;

 private:
  Feet feet_;
};

// Waits, then goes through the gears as a practised hand does.
inline ScriptedHand shifting_hand(const Gate& gate, int from, std::vector<int> gears, double wait = 0.2,
                                  double dwell = 0.5) {
  const glm::dvec2 start = rest_position(gate, from);
  ShiftStyle style;
  style.dwell_gear = dwell;
  std::vector<HandStroke> strokes{{start, wait, 0.0, {}, false, false}};
  for (const HandStroke& stroke : shift_strokes(gate, start, gears, style)) strokes.push_back(stroke);
  return {touring_hand(start), std::move(strokes), 0.001};
}

// In that gear, the shaft turning so fast, engine and clutch with it.
inline CarStart rolling_in(const CarSpec& car, int gear, double shaft_speed) {
  CarStart start;
  start.gear = gear;
  start.road_speed = road_speed_at(car, gear, shaft_speed);
  return start;
}

}  // namespace gearshift
