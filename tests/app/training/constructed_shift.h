// A shift from 2 to 3 in the paper's gate, put together from straight lines: every number of it is known by hand.
//
// Time runs from the moment the clutch pedal begins to go down, in seconds:
//   -1.0 to 2.0   road speed 12 m/s, road speed and engine steady but for what follows
//   -0.2          throttle from 0.3 to 0 at once
//    0.0 to 0.1   pedal 0 to 1: passes the bite point, 0.75, at 0.075
//    0.2 to 0.3   lever from 2's rest to the aisle, at constant speed
//    0.3 to 0.4   along the aisle
//    0.4 to 0.5   to 3's rest
//    0.6 to 0.8   pedal 1 to 0: passes the bite point at 0.65; the clutch is locked from 0.75 on
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "app/training/drive_sample.h"
#include "app/training/shift_meter.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

namespace gearshift {

inline CarSpec test_car() {
  CarSpec car;
  car.name = car.title = "test";
  car.gearbox.ratio = {3.45, 1.95, 1.29, 0.97, 0.76, 0.63};
  car.gearbox.reverse = 3.17;
  return car;
}

// Read once.
inline const Gate& known_gate() {
  static const Gate gate = paper_gate();
  return gate;
}

struct ConstructedShift {
  Gate gate = known_gate();
  CarSpec car = test_car();
  double period = 1e-3;
  double from = -1.0, to = 2.0;  // [s]
  std::function<void(DriveSample&, double)> spoil = [](DriveSample&, double) {};

  static constexpr double kSpeed = 12.0;  // [m/s]
  double engine(int gear) const { return shaft_per_road(car, gear) * kSpeed; }

  // Straight from a to b between the times t0 and t1, constant outside.
  static double line(double t, double t0, double a, double t1, double b) {
    if (t <= t0) return a;
    return t >= t1 ? b : a + (b - a) * (t - t0) / (t1 - t0);
  }

  void place(DriveSample& s, glm::dvec2 lever) const {
    s.lever.lever = s.lever.proxy = lever;
    s.lever.slot = slot_at(gate, lever);
  }

  // Out at the release depth, in at the engage depth.
  void mesh(DriveSample& s, int before) const {
    const double depth = std::abs(s.lever.proxy.y);
    const bool in_slot = s.lever.slot != kNoSlot;
    const Slot slot = in_slot ? slot_of(gate, s.lever.slot) : Slot{};
    const bool in = in_slot && depth >= (slot.gear == before ? slot.release_depth : slot.engage_depth);
    s.car.gear = s.lever.gear = in ? slot.gear : kNeutralGear;
  }

  DriveSample at(double t, int gear_before) const {
    DriveSample s;
    s.lever.time_ns = std::llround(1e9 * (t + 100.0));
    const glm::dvec2 two = rest_position(gate, 2), three = rest_position(gate, 3);
    const double y = t < 0.35 ? line(t, 0.2, two.y, 0.3, 0.0) : line(t, 0.4, 0.0, 0.5, three.y);
    place(s, {line(t, 0.3, two.x, 0.4, three.x), y});
    mesh(s, gear_before);
    s.car.ignition = s.controls.ignition = true;
    s.car.throttle = s.controls.throttle = t < -0.2 ? 0.3 : 0.0;
    s.car.clutch = s.controls.clutch = t < 0.35 ? line(t, 0.0, 0.0, 0.1, 1.0) : line(t, 0.6, 1.0, 0.8, 0.0);
    s.car.clutch_locked = t < 0.075 || t > 0.75;
    s.car.clutch_torque = s.car.clutch_locked || t > 0.65 ? 40.0 : 0.0;
    s.car.road_speed = kSpeed;
    s.car.distance = kSpeed * t;
    s.car.engine_speed = line(t, 0.1, engine(2), 0.6, engine(3));
    s.car.shaft_speed = s.car.engine_speed;
    return s;
  }

  std::vector<DriveSample> samples() const {
    std::vector<DriveSample> list;
    int gear = 2;
    const auto first = std::lround(from / period), last = std::lround(to / period);
    for (auto i = first; i <= last; ++i) {
      const double t = static_cast<double>(i) * period;
      DriveSample s = at(t, gear);
      spoil(s, t);
      gear = s.car.gear;
      list.push_back(s);
    }
    return list;
  }

  std::vector<ShiftRecord> records() const {
    ShiftMeter meter(car, gate);
    std::vector<ShiftRecord> list;
    for (const DriveSample& s : samples()) {
      if (const auto record = meter.add(s)) list.push_back(*record);
    }
    return list;
  }
};

}  // namespace gearshift
