#include "app/lab/bench/driveline/drives.h"

#include <algorithm>

#include "app/lab/bench/driveline/driveline_rig.h"
#include "haptics/files/parameter.h"

namespace gearshift::lab {
namespace {

Drive drive_of(const char* name, double engine, double road, int gear, double duration) {
  Drive drive;
  drive.name = name;
  drive.car = hatchback();
  drive.engine = engine;
  drive.road = road;
  drive.shaft = vehicle::shaft_per_road(drive.car, gear) * road;
  drive.duration = duration;
  return drive;
}

}  // namespace

double ramp(double seconds, double start, double end, double from, double to) {
  return from + (to - from) * std::clamp((seconds - start) / (end - start), 0.0, 1.0);
}

vehicle::CarSpec hatchback() {
  vehicle::CarSpec car;
  const double table[][2] = {{600, 70},   {1000, 95},  {1500, 115}, {2000, 125}, {3000, 138},
                             {4000, 145}, {5000, 138}, {6000, 117}, {6500, 60},  {7000, 0}};
  for (const auto& [rpm, torque] : table)
    car.engine.full_load[car.engine.points++] = {rpm * haptics::kTurnPerMinute, torque};
  car.engine.friction = 8.0;
  car.engine.friction_slope = 0.002;
  car.engine.friction_square = 3.5e-5;
  car.gearbox.ratio = {3.45, 1.94, 1.29, 0.97, 0.76};
  car.gearbox.reverse = 3.4;
  car.gearbox.final_drive = 4.08;
  return car;
}

Drive launch() {
  Drive drive = drive_of("launch", 84.0, 0.0, 1, 2.5);
  drive.input = [](double t) { return pedals(1, ramp(t, 0.0, 0.5, 0.0, 0.25), ramp(t, 0.3, 1.8, 1.0, 0.0)); };
  return drive;
}

Drive launch_of(const vehicle::CarSpec& car) {
  Drive drive = drive_of("launch of the shipped car", car.engine.idle, 0.0, 1, 2.5);
  drive.car = car;
  drive.input = [](double t) { return pedals(1, ramp(t, 0.0, 0.5, 0.0, 0.35), ramp(t, 0.3, 1.8, 1.0, 0.0)); };
  return drive;
}

Drive pull_away(const vehicle::CarSpec& car, int gear, double seconds) {
  Drive drive = drive_of("pulling away without throttle", car.engine.idle, 0.0, gear, 0.5 + seconds + 2.0);
  drive.car = car;
  const double bite = car.clutch.bite, closed = car.clutch.closed;
  drive.input = [=](double t) {
    const double let_up = ramp(t, 0.5, 0.5 + seconds, bite, closed);
    return pedals(gear, 0.0, t < 0.5 ? ramp(t, 0.2, 0.5, 1.0, bite) : let_up);
  };
  return drive;
}

Drive dump_at_idle() {
  Drive drive = drive_of("clutch dump at idle", 84.0, 0.0, 1, 1.0);
  drive.input = [](double t) { return pedals(1, 0.0, ramp(t, 0.1, 0.13, 1.0, 0.0)); };
  return drive;
}

Drive dump_at_4000() {
  Drive drive = drive_of("clutch dump at 4000 rpm", 4000.0 * haptics::kTurnPerMinute, 0.0, 1, 2.0);
  drive.input = [](double t) { return pedals(1, 0.8, ramp(t, 0.02, 0.05, 1.0, 0.0)); };
  return drive;
}

Drive money_shift() {
  Drive drive = drive_of("money shift into second at 30 m/s", 300.0, 30.0, 2, 1.5);
  drive.input = [](double t) { return pedals(2, 0.0, ramp(t, 0.1, 0.3, 1.0, 0.0)); };
  return drive;
}

Drive rollback() {
  Drive drive = drive_of("rollback on a hill", 84.0, 0.0, 1, 3.0);
  drive.input = [](double t) {
    vehicle::DrivelineInput in = pedals(1, ramp(t, 0.3, 0.8, 0.0, 0.5), ramp(t, 0.6, 2.0, 1.0, 0.0));
    in.slope = 0.12;
    in.pedals.brake = ramp(t, 0.1, 0.2, 0.5, 0.0);
    return in;
  };
  return drive;
}

Drive reverse_ahead() {
  Drive drive = drive_of("reverse engaged at 5 m/s forwards", 200.0, 5.0, haptics::kReverseGear, 3.0);
  drive.input = [](double t) { return pedals(haptics::kReverseGear, 0.6, ramp(t, 0.1, 1.1, 1.0, 0.3)); };
  return drive;
}

Drive first_backwards() {
  Drive drive = drive_of("first engaged at 4 m/s backwards", 300.0, -4.0, 1, 3.0);
  drive.input = [](double t) { return pedals(1, 0.7, ramp(t, 0.1, 0.9, 1.0, 0.2)); };
  return drive;
}

Drive cone_only() {
  Drive drive = drive_of("synchroniser cone, clutch down", 84.0, 15.0, 0, 1.0);
  drive.shaft = 400.0;
  drive.input = [](double t) {
    vehicle::DrivelineInput in = pedals(0, 0.0, 1.0);
    in.cone_gear = 3;
    in.cone_torque = ramp(t, 0.1, 0.15, 0.0, 11.4);
    return in;
  };
  return drive;
}

Drive cone_and_engine() {
  Drive drive = drive_of("cone, clutch up", 300.0, 12.0, 0, 3.0);
  drive.shaft = 300.0;
  drive.input = [](double t) {
    vehicle::DrivelineInput in = pedals(0, ramp(t, 2.0, 2.1, 0.0, 0.5), 0.0);
    in.cone_gear = 2;
    in.cone_torque = ramp(t, 0.1, 0.15, 0.0, 20.0);
    return in;
  };
  return drive;
}

Drive rolls_back_dead() {
  Drive drive = drive_of("rolling back with a dead engine", 0.0, -0.01, 1, 2.5);
  drive.car.engine.compression = 45.0;
  drive.running = false;
  drive.input = [](double t) {
    vehicle::DrivelineInput in = pedals(1, 0.0, ramp(t, 0.8, 1.2, 1.0, 0.0));
    in.slope = 0.3;
    return in;
  };
  return drive;
}

Drive bump_start() {
  Drive drive = drive_of("bump start in second", 0.0, 15.0 / haptics::kKmhPerMps, 2, 2.5);
  drive.car.engine.compression = 45.0;
  drive.running = false;
  drive.input = [](double t) { return pedals(2, 0.1, ramp(t, 0.2, 0.7, 1.0, 0.0)); };
  return drive;
}

Drive cranking() {
  Drive drive = drive_of("starting the engine", 0.0, 0.0, 0, 2.5);
  drive.car.engine.idle_integral_gain = 0.02;
  drive.car.engine.compression = 45.0;
  drive.running = false;
  drive.shaft = 0.5;
  drive.input = [](double t) {
    vehicle::DrivelineInput in = pedals(0, 0.0, 1.0);
    in.starter = t > 0.1 && t < 1.5;
    return in;
  };
  return drive;
}

Drive hot_launch() {
  Drive drive = launch();
  drive.name = "launch with a hot clutch";
  drive.car.clutch.heat_capacity = 50.0;
  drive.car.clutch.cooling = 0.5;
  drive.temperature = 300.0;
  return drive;
}

std::vector<Drive> all_drives() {
  return {launch(),        dump_at_idle(),    dump_at_4000(), money_shift(),    rollback(),
          reverse_ahead(), first_backwards(), cone_only(),    cone_and_engine()};
}

std::vector<Drive> engine_drives() {
  return {rolls_back_dead(), bump_start(), cranking(), hot_launch()};
}

}  // namespace gearshift::lab
