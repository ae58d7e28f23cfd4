// A lesson in the real car at 1 kHz, driven by a script of the test, without a simulated driver and without a haptic
// loop.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>

#include "app/lessons/assessment/lesson_run.h"
#include "app/vehicle/car_load.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

namespace gearshift::test {

struct ScriptedDrive {
  lessons::Lesson lesson;
  vehicle::CarSpec car;
  haptics::Gate gate;
  vehicle::CarLoad load;
  lessons::LessonRun run;
  haptics::DriverControls feet;
  // Without norms: this lever has no mass and this hand no force, so its figures are not those of a drive.
  static lessons::Lesson judged_by_errors(const std::string& key) {
    lessons::Lesson lesson = lessons::read_lesson(GEARSHIFT_ASSETS "/lessons/" + key + ".toml");
    lesson.norms.clear();
    return lesson;
  }

  double push = 25.0;   // [N] the hand's force against a blocking synchroniser ring
  double speed = 0.35;  // [m/s] speed of the hand
  double pause = 0.0;   // [s] how long the driver waits before the clutch comes up, or before braking
  std::function<void(vehicle::DriveSample&)> modify = [](vehicle::DriveSample&) {
  };  // changes each sample before the lesson receives it

  // Uses the car and the gate that the lesson names. If the lesson names none, uses `other_car` and that car's gate.
  explicit ScriptedDrive(const std::string& key, lessons::LessonMode mode = lessons::LessonMode::follow_me,
                         const std::string& other_car = "hatchback")
      : lesson(judged_by_errors(key)),
        car(vehicle::read_car(GEARSHIFT_ASSETS "/cars/" + (lesson.car.empty() ? other_car : lesson.car) + ".toml")),
        gate(shipped_gate(lesson.gate.empty() ? car.gate : lesson.gate)),
        load(car, gate, kMaxForce, lessons::car_start(lesson.start), 1),
        run(lesson, car, gate, {mode, 0.0, lessons::HintStyle::prescriptive}),
        at_(haptics::rest_position(gate, lesson.start.gear)),
        goal_(lesson.start.gear) {
    feet.ignition = lesson.start.running;
    feet.pedals.hand_brake = lesson.start.hand_brake;
    feet.pedals.brake = lesson.start.brake;
    feet.slope = lesson.start.slope;
    haptics::LeverInput in;
    in.position = in.proxy = at_;
    in.slot = haptics::slot_at(gate, at_);
    in.depth = std::abs(at_.y);
    in.controls = feet;
    out_ = load.step(in, 0.0);
  }

  const vehicle::VehicleState& now() const { return load.state(); }
  double km_per_h() const { return haptics::kKmhPerMps * now().road_speed; }
  double rpm() const { return now().engine_speed / kRpm; }
  double rpm_in(int gear) const { return vehicle::shaft_per_road(car, gear) * std::abs(now().road_speed) / kRpm; }
  bool is_standing() const { return std::abs(km_per_h()) < 0.05; }
  double time() const { return time_; }

  void wait(double seconds) {
    for (double t = 0.0; t < seconds && !run.is_over(); t += kPeriod) tick();
  }
  // Advances the drive until `holds` returns true, the lesson ends, or `max_seconds` have passed.
  void until(const std::function<bool()>& holds, double max_seconds = 30.0) {
    for (double t = 0.0; t < max_seconds && !run.is_over() && !holds(); t += kPeriod) tick();
  }
  void press(double& pedal, double to, double seconds) {
    const double rate = (to - pedal) * kPeriod / seconds;
    for (double t = 0.0; t < seconds && !run.is_over(); t += kPeriod) pedal += rate, tick();
    pedal = to;
  }
  void clutch_down() { press(feet.pedals.clutch, 1.0, 0.2); }
  void lever(int gear, double max_seconds = 5.0) {
    goal_ = gear;
    until([&] { return now().gear == gear && glm::distance(at_, haptics::rest_position(gate, gear)) < 1e-3; },
          max_seconds);
  }
  void start_towards(int gear) { goal_ = gear; }  // returns at once; the hand moves during later calls
  bool in_aisle() const { return std::abs(at_.y) < 1e-3; }

  const lessons::LessonResult& leave() {
    run.leave();
    return run.result();
  }
  // Waits for feedback that the lesson has yet to report, and leaves the lesson.
  const lessons::LessonResult& finish() {
    wait(6.0);
    run.leave();
    return run.result();
  }

 private:
  static constexpr double kPeriod = 1e-3;       // [s]
  static constexpr double kMaxForce = 31.7;     // [N]
  static constexpr double kRpm = 0.1047197551;  // [rad/s]
  static constexpr double kFreeForce = 3.0;     // [N] the hand's force while nothing blocks the lever

  void tick() {
    const glm::dvec2 to_aim = aim() - at_;
    const double length = glm::length(to_aim);
    glm::dvec2 to = length > 1e-9 ? at_ + to_aim * std::min(1.0, speed * kPeriod / length) : at_;
    glm::dvec2 force = length > 1e-4 ? to_aim / length * kFreeForce : glm::dvec2{0.0};
    respect_ring(to, force);
    at_ = to;
    step(force);
  }

  // The next point on the lever's way: out of the old slot, along the aisle, and into the slot of gear `goal_`.
  glm::dvec2 aim() const {
    const glm::dvec2 rest = haptics::rest_position(gate, goal_);
    const bool other_column = std::abs(at_.x - rest.x) > 1e-4;
    if (std::abs(at_.y) > 1e-4 && (other_column || goal_ == haptics::kNeutralGear)) return {at_.x, 0.0};
    return other_column ? glm::dvec2{rest.x, 0.0} : rest;
  }

  void respect_ring(glm::dvec2& to, glm::dvec2& force) const {
    const int slot = haptics::slot_at(gate, at_);
    if (slot == haptics::kNoSlot || out_.limited_slot != slot) return;
    const double side = static_cast<double>(static_cast<int>(haptics::slot_of(gate, slot).side));
    const double depth = std::abs(at_.y), wanted = to.y * side;
    if (wanted > out_.depth_max && wanted > depth) {
      to.y = side * std::max(depth, out_.depth_max);
      force = {0.0, side * push};
    } else if (wanted < out_.depth_min && wanted < depth) {
      to.y = side * std::min(depth, out_.depth_min);
      force = {0.0, -side * push};
    }
  }

  void step(glm::dvec2 force) {
    haptics::LeverInput in;
    in.position = in.proxy = at_;
    in.push = force;
    in.slot = haptics::slot_at(gate, at_);
    in.depth = in.slot == haptics::kNoSlot ? 0.0 : std::abs(at_.y);
    in.gear = now().gear;
    in.controls = feet;
    out_ = load.step(in, kPeriod);
    time_ += kPeriod;
    vehicle::DriveSample sample;
    sample.lever.time_ns = std::llround(1e9 * time_);
    sample.lever.cycle = ++cycle_;
    sample.lever.lever = sample.lever.proxy = at_;
    sample.lever.f_h = force;
    sample.lever.slot = in.slot;
    sample.lever.gear = now().gear;
    sample.controls = feet;
    sample.car = now();
    modify(sample);
    run.add(sample);
  }

  glm::dvec2 at_;
  int goal_;
  haptics::LeverOutput out_;
  double time_ = 100.0;
  std::uint64_t cycle_ = 0;
};

// A competent driver. Where no comment says otherwise, the driver does what driving schools teach.
struct Able {
  ScriptedDrive& d;

  void hold_revs(double rpm) { d.feet.pedals.throttle = std::clamp(0.20 + 0.0012 * (rpm - d.rpm()), 0.0, 0.8); }

  // Moves off from a standstill, in gear and with the clutch down. Returns when the clutch is up.
  void launch(double rpm = 1500.0) {
    d.feet.pedals.brake = 0.0;
    d.press(d.feet.pedals.clutch, d.car.clutch.bite + 0.02, 0.4);
    launch_from_bite(rpm);
  }

  void launch_from_bite(double rpm = 1500.0) {
    d.until(
        [&] {
          hold_revs(rpm);
          if (d.rpm() > 0.85 * rpm || d.now().clutch_locked)
            d.feet.pedals.clutch = std::max(0.0, d.feet.pedals.clutch - 0.25e-3);
          return d.now().clutch_locked && d.feet.pedals.clutch < 0.25;
        },
        10.0);
    d.press(d.feet.pedals.clutch, 0.0, 0.3);
  }

  void lift() { d.press(d.feet.pedals.throttle, 0.0, 0.15); }

  void shift(int gear, double up = 0.8) {
    lift();
    d.clutch_down();
    d.lever(gear);
    d.wait(d.pause);
    d.press(d.feet.pedals.clutch, 0.0, up);
  }

  // Shifts down with the blip that the lower gear needs.
  void shift_with_blip(int gear) {
    lift();
    d.clutch_down();
    d.lever(gear);
    d.wait(d.pause);
    double fits_since = d.time();
    d.until(
        [&] {
          const double wanted = d.rpm_in(gear);
          d.feet.pedals.throttle = std::clamp(0.06 + 0.002 * (wanted - d.rpm()), 0.0, 0.6);
          if (std::abs(wanted - d.rpm()) > 80.0) fits_since = d.time();
          return d.time() - fits_since > 0.1;
        },
        2.0);
    d.feet.pedals.throttle = 0.0;
    d.press(d.feet.pedals.clutch, 0.0, 0.4);
  }

  void accelerate(const std::function<bool()>& enough, double throttle = 0.35) {
    d.press(d.feet.pedals.throttle, throttle, 0.3);
    d.until(enough);
  }
  void accelerate_to_rpm(double rpm) {
    accelerate([&] { return d.rpm() > rpm; });
  }
  void accelerate_to(double km_per_h, double throttle = 0.35) {
    accelerate([&] { return std::abs(d.km_per_h()) > km_per_h; }, throttle);
  }

  void slow_to(double km_per_h) {
    lift();
    d.press(d.feet.pedals.brake, 0.2, 0.2);
    d.until([&] { return d.km_per_h() < km_per_h; });
    d.press(d.feet.pedals.brake, 0.0, 0.2);
  }

  void stop(double brake = 0.3) {
    lift();
    d.press(d.feet.pedals.brake, brake, 0.3);
    d.until([&] { return d.rpm() < 1100.0 || !d.now().clutch_locked; });
    d.clutch_down();
    d.until([&] { return d.is_standing(); });
    d.wait(0.3);
  }

  void start_engine() {
    d.feet.ignition = d.feet.starter = true;
    d.until([&] { return d.rpm() > 650.0; }, 3.0);
    d.wait(0.1);
    d.feet.starter = false;
    d.wait(0.8);
  }
};

inline std::string errors_text(const lessons::LessonResult& result, bool with_notes = false) {
  std::string list;
  for (const lessons::DrivingError& error : result.errors) {
    if (with_notes || error.severity != lessons::Severity::note) list += lessons::error_sentence(error) + " ";
  }
  return list;
}

}  // namespace gearshift::test
