// Drives a lesson as it is meant, without physics: pedals, lever, engine and car move along straight lines, and the
// engine turns as the gear asks. What it shows can be spoilt on its way to the lesson.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>

#include "app/training/lesson_run.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift {

class IdealDriver {
 public:
  IdealDriver(const Lesson& lesson, const CarSpec& car, const Gate& gate) : lesson_(lesson), car_(car), gate_(gate) {
    now_.lever.time_ns = 100'000'000'000;
    place(rest_position(gate, lesson.start.gear));
    now_.car.gear = lesson.start.gear;
    now_.car.running = lesson.start.running;
    now_.car.ignition = lesson.start.running;
    now_.car.hand_brake = lesson.start.hand_brake;
    now_.car.road_speed = wanted_speed_ = lesson.start.speed;
    now_.car.engine_speed = std::max(shaft_per_road(car, lesson.start.gear) * lesson.start.speed, idle());
    if (!lesson.start.running) now_.car.engine_speed = 0.0;
    rev_goal_ = car.engine.idle;
  }

  std::function<void(DriveSample&)> spoil = [](DriveSample&) {};
  double pause = 0.0;  // [s] between gear and clutch
  bool late = false;   // begins a step only once its time is over

  void drive(LessonRun& run) {
    run_ = &run;
    wait(0.5);
    for (std::size_t step = 0; step < lesson_.steps.size() && !run.is_over(); ++step) {
      if (run.view().step > step) continue;  // passed over
      if (late) wait(lesson_.steps[step].within.value_or(0.0));
      act(step);
      const DriveCondition& c = lesson_.steps[step].until;
      const bool travels = c.speed_above || c.speed_below || c.engine_above || c.rolled_back_above;
      for (double t = 0.0; t < (travels ? 15.0 : 2.0) && !run.is_over() && run.view().step == step; t += kPeriod)
        tick();
    }
    for (double t = 0.0; t < 5.0 && !run.is_over(); t += kPeriod) tick();
  }

 private:
  static constexpr double kPeriod = 0.002;  // [s]

  double idle() const { return car_.engine.idle; }
  double asked() const { return shaft_per_road(car_, now_.car.gear) * now_.car.road_speed; }
  bool over() const { return run_->is_over(); }

  void place(glm::dvec2 p) {
    now_.lever.lever = now_.lever.proxy = p;
    now_.lever.slot = slot_at(gate_, p);
  }

  static double towards(double from, double to, double most) { return from + std::clamp(to - from, -most, most); }

  void tick() {
    VehicleState& car = now_.car;
    now_.lever.time_ns += 2'000'000;
    const bool open = car.clutch >= car_.clutch.bite;
    const bool driven = car.gear != kNeutralGear && !open;
    double wish = driven ? std::clamp(wanted_speed_ - car.road_speed, -1.0, 1.2) : 0.0;
    if (car.brake > 0.0 || car.hand_brake > 0.5)
      wish = -6.0 * std::max(car.brake, 0.2) * (car.road_speed > 0.0 ? 1 : -1);
    car.acceleration += (wish - car.acceleration) * kPeriod / 0.25;
    car.road_speed += car.acceleration * kPeriod;
    const bool braked = car.brake > 0.0 || car.hand_brake > 0.5;
    if (braked && std::abs(car.road_speed) < 0.05) car.road_speed = car.acceleration = 0.0;
    car.distance += car.road_speed * kPeriod;
    turn_engine(driven);
    car.slip_power = driven && !car.clutch_locked ? 500.0 : 0.0;
    car.slip_energy += car.slip_power * kPeriod;
    car.clutch_torque = driven ? 30.0 : 0.0;
    car.engine_torque = 20.0;
    DriveSample shown = now_;
    shown.controls.clutch = car.clutch;
    spoil(shown);
    run_->add(shown);
  }

  void turn_engine(bool driven) {
    VehicleState& car = now_.car;
    const double goal = driven ? std::max(asked(), idle()) : rev_goal_;
    car.engine_speed = car.running ? towards(car.engine_speed, goal, 500.0 * kPeriod) : 0.0;
    car.clutch_locked = car.clutch < car_.clutch.bite && std::abs(car.engine_speed - asked()) < 1.0;
    car.shaft_speed = asked();
  }

  void wait(double seconds) {
    for (double t = 0.0; t < seconds && !over(); t += kPeriod) tick();
  }

  void press(double& pedal, double to, double seconds) {
    const double rate = kPeriod / seconds;
    while (pedal != to && !over()) {
      pedal = towards(pedal, to, rate);
      tick();
    }
  }

  void clutch_down(std::size_t step) {
    press(now_.car.throttle, 0.0, 0.1);
    int next = now_.car.gear;
    for (std::size_t i = step; i < lesson_.steps.size() && next == now_.car.gear; ++i) {
      next = lesson_.steps[i].until.gear.value_or(now_.car.gear);
    }
    rev_goal_ = std::max(idle(), shaft_per_road(car_, next) * now_.car.road_speed);
    press(now_.car.clutch, 1.0, 0.15);
    wait(0.1);
  }

  void clutch_up(double wanted_speed) {
    wanted_speed_ = wanted_speed;
    if (now_.car.clutch == 0.0) return;
    wait(pause);
    press(now_.car.clutch, 0.0, 0.6);
  }

  void move(glm::dvec2 to) {
    while (glm::distance(now_.lever.proxy, to) > 1e-9 && !over()) {
      const glm::dvec2 way = to - now_.lever.proxy;
      place(now_.lever.proxy + way * std::min(1.0, 0.25 * kPeriod / glm::length(way)));
      mesh();
      tick();
    }
  }

  void mesh() {
    const double depth = std::abs(now_.lever.proxy.y);
    now_.car.gear = kNeutralGear == before_ ? now_.car.gear : before_;
    if (now_.lever.slot == kNoSlot) {
      now_.car.gear = before_ = kNeutralGear;
      return;
    }
    const Slot& slot = slot_of(gate_, now_.lever.slot);
    const bool in = depth >= (slot.gear == before_ ? slot.release_depth : slot.engage_depth);
    now_.car.gear = before_ = in ? slot.gear : kNeutralGear;
  }

  void shift(int gear) {
    before_ = now_.car.gear;
    const glm::dvec2 rest = rest_position(gate_, gear);
    move({now_.lever.proxy.x, 0.0});
    move({rest.x, 0.0});
    move(rest);
    wait(0.1);
  }

  void stop(std::size_t step) {
    press(now_.car.throttle, 0.0, 0.1);
    press(now_.car.brake, std::max(now_.car.brake, 0.5), 0.2);
    while (std::abs(now_.car.road_speed) > 3.0 && !over()) tick();
    clutch_down(step);
    while (now_.car.road_speed != 0.0 && !over()) tick();
    press(now_.car.brake, 0.0, 0.2);
  }

  void slow_down(double speed) {
    press(now_.car.throttle, 0.0, 0.1);
    wanted_speed_ = 0.9 * speed;
    while (now_.car.road_speed > 0.95 * speed && !over()) tick();
    wanted_speed_ = now_.car.road_speed;
  }

  void drive_to(double speed) {
    clutch_up(speed);
    press(now_.car.throttle, 0.3, 0.2);
  }

  // What the step's condition asks for, in an order in which a person would do it.
  void act(std::size_t index) {
    const DriveCondition& c = lesson_.steps[index].until;
    if (c.ignition == false) now_.car.ignition = now_.car.running = false;
    if (c.running == true && !now_.car.running) start();
    const bool at_hand_brake = c.engine_above && c.hand_brake_above;
    if (c.hand_brake_above) press(now_.car.hand_brake, 1.0, 0.3);
    if (c.hand_brake_below) press(now_.car.hand_brake, 0.0, 0.2);
    if (c.brake_above) press(now_.car.brake, 1.0, 0.1);
    if (c.brake_above) return;
    if (at_hand_brake) {
      rev_goal_ = *c.engine_above + 20.0;
      now_.car.clutch = 0.78;
      return;
    }
    const bool stands = c.speed_below && *c.speed_below < 0.5 && std::abs(now_.car.road_speed) > 0.0;
    if (stands) stop(index);
    if (c.speed_below && !c.speed_above) slow_down(*c.speed_below);
    if (c.clutch_above && now_.car.clutch < 1.0) clutch_down(index);
    if (c.gear && *c.gear != now_.car.gear) {
      if (now_.car.clutch < 1.0) clutch_down(index);
      shift(*c.gear);
    }
    go(c);
  }

  void go(const DriveCondition& c) {
    const double per_road = shaft_per_road(car_, now_.car.gear);
    if (c.rolled_back_above) return clutch_up(-2.0);
    if (c.speed_above && c.speed_below && *c.speed_below > 0.5)
      return clutch_up(0.5 * (*c.speed_above + *c.speed_below));
    if (c.speed_above && *c.speed_above > 0.0) return drive_to(1.1 * *c.speed_above + 1.5);
    if (c.engine_above && !c.clutch_below) return drive_to((*c.engine_above + 8.0) / per_road + 0.5);
    if (c.clutch_below || c.clutch_locked) {
      clutch_up(std::max(now_.car.road_speed, 1.2 * idle() / per_road));
      press(now_.car.throttle, 0.3, 0.2);
    }
  }

  void start() {
    now_.car.ignition = true;
    wait(0.5);
    now_.car.running = true;
  }

  Lesson lesson_;
  CarSpec car_;
  Gate gate_;
  LessonRun* run_ = nullptr;
  DriveSample now_;
  double wanted_speed_ = 0.0;
  double rev_goal_ = 0.0;
  int before_ = kNeutralGear;
};

}  // namespace gearshift
