// A shift from second to third gear in the paper's gate, built from straight lines, so that every number in its
// ShiftRecord can be computed by hand.
//
// The clutch pedal begins to go down at 0 s. The samples cover the time from -1.0 s to 2.0 s:
//   always         The road speed is 12 m/s.
//   -0.2 s         The throttle steps from 0.3 to 0.
//   0.0 to 0.1 s   The clutch pedal goes from 0 to 1 and passes the bite point (0.75) at 0.075 s.
//   0.1 to 0.6 s   The engine speed changes linearly from the speed that second needs to the speed that third needs.
//   0.2 to 0.3 s   The lever moves at constant speed from the rest position of second to the aisle.
//   0.3 to 0.4 s   The lever moves along the aisle.
//   0.4 to 0.5 s   The lever moves to the rest position of third.
//   0.6 to 0.8 s   The clutch pedal goes from 1 to 0 and passes the bite point at 0.65 s.
//   0.75 s         The clutch locks.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "app/lessons/assessment/shift_meter.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

namespace gearshift::test {

inline vehicle::CarSpec test_car() {
  vehicle::CarSpec car;
  car.name = car.title = "test";
  car.gearbox.ratio = {3.45, 1.95, 1.29, 0.97, 0.76, 0.63};
  car.gearbox.reverse = 3.17;
  return car;
}

// One gate for all tests, so that its file is read only once.
inline const haptics::Gate& known_gate() {
  static const haptics::Gate gate = paper_gate();
  return gate;
}

struct ConstructedShift {
  haptics::Gate gate = known_gate();
  vehicle::CarSpec car = test_car();
  double period = 1e-3;
  double from = -1.0, to = 2.0;  // [s] time of the first and last sample
  std::function<void(vehicle::DriveSample&, double)> modify = [](vehicle::DriveSample&, double) {};

  static constexpr double kSpeed = 12.0;  // [m/s]
  double engine(int gear) const { return vehicle::shaft_per_road(car, gear) * kSpeed; }

  // Linear from `a` at time `t0` to `b` at time `t1`, and constant before and after.
  static double line(double t, double t0, double a, double t1, double b) {
    if (t <= t0) return a;
    return t >= t1 ? b : a + (b - a) * (t - t0) / (t1 - t0);
  }

  void place(vehicle::DriveSample& s, glm::dvec2 lever) const {
    s.lever.lever = s.lever.proxy = lever;
    s.lever.slot = haptics::slot_at(gate, lever);
  }

  // A gear disengages at the slot's release depth and engages at its engage depth.
  void mesh(vehicle::DriveSample& s, int before) const {
    const double depth = std::abs(s.lever.proxy.y);
    const bool in_slot = s.lever.slot != haptics::kNoSlot;
    const haptics::Slot slot = in_slot ? haptics::slot_of(gate, s.lever.slot) : haptics::Slot{};
    const bool in = in_slot && depth >= (slot.gear == before ? slot.release_depth : slot.engage_depth);
    s.car.gear = s.lever.gear = in ? slot.gear : haptics::kNeutralGear;
  }

  vehicle::DriveSample at(double t, int gear_before) const {
    vehicle::DriveSample s;
    s.lever.time_ns = std::llround(1e9 * (t + 100.0));
    const glm::dvec2 two = haptics::rest_position(gate, 2), three = haptics::rest_position(gate, 3);
    const double y = t < 0.35 ? line(t, 0.2, two.y, 0.3, 0.0) : line(t, 0.4, 0.0, 0.5, three.y);
    place(s, {line(t, 0.3, two.x, 0.4, three.x), y});
    mesh(s, gear_before);
    s.car.ignition = s.controls.ignition = true;
    s.car.pedals.throttle = s.controls.pedals.throttle = t < -0.2 ? 0.3 : 0.0;
    s.car.pedals.clutch = s.controls.pedals.clutch =
        t < 0.35 ? line(t, 0.0, 0.0, 0.1, 1.0) : line(t, 0.6, 1.0, 0.8, 0.0);
    s.car.clutch_locked = t < 0.075 || t > 0.75;
    s.car.clutch_torque = s.car.clutch_locked || t > 0.65 ? 40.0 : 0.0;
    s.car.road_speed = kSpeed;
    s.car.distance = kSpeed * t;
    s.car.engine_speed = line(t, 0.1, engine(2), 0.6, engine(3));
    s.car.shaft_speed = s.car.engine_speed;
    return s;
  }

  std::vector<vehicle::DriveSample> samples() const {
    std::vector<vehicle::DriveSample> list;
    int gear = 2;
    const auto first = std::lround(from / period), last = std::lround(to / period);
    for (auto i = first; i <= last; ++i) {
      const double t = static_cast<double>(i) * period;
      vehicle::DriveSample s = at(t, gear);
      modify(s, t);
      gear = s.car.gear;
      list.push_back(s);
    }
    return list;
  }

  std::vector<lessons::ShiftRecord> records() const {
    lessons::ShiftMeter meter(car, gate);
    std::vector<lessons::ShiftRecord> list;
    for (const vehicle::DriveSample& s : samples()) {
      if (const auto record = meter.add(s)) list.push_back(*record);
    }
    return list;
  }
};

}  // namespace gearshift::test
