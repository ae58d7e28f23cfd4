// A step: what it takes in, and what it shows. How it moves: driveline_motion.cpp.
#include "app/vehicle/driveline.h"

#include <algorithm>
#include <cmath>

#include "app/vehicle/shift_advice.h"
#include "app/vehicle/shudder.h"

namespace gearshift {
namespace {

constexpr double kLongestStep = 0.5;     // [s]
constexpr double kLongestPiece = 0.002;  // [s] of the midpoint rule
constexpr double kGravity = 9.81;        // [m/s^2]
constexpr double kMostTorque = 1e5;      // [N m] of a grip: any two speeds here are one within microseconds

double finite(double value) noexcept {
  return std::isfinite(value) ? value : 0.0;
}

double pedal(double value) noexcept {
  return std::clamp(finite(value), 0.0, 1.0);
}

}  // namespace

Driveline::Driveline(const CarSpec& car) : car_(car), engine_(car.engine) {
  car_.clutch.capacity = std::min(car.clutch.capacity, kMostTorque);
  chain_.inertia = {car.engine.inertia, car.clutch.disc_inertia, car.body.mass + car.body.rotating};
  chain_.efficiency = car.gearbox.efficiency;
  state_.red_line = car.engine.red_line;
  state_.clutch_bite = car.clutch.bite;
  state_.clutch_closed = car.clutch.closed;
  place(car.engine.idle, 0.0, 0.0, true);
}

void Driveline::place(double engine_speed, double shaft_speed, double road_speed, bool running, bool stalled) noexcept {
  speed_ = {std::max(0.0, finite(engine_speed)), finite(shaft_speed), finite(road_speed)};
  engine_.set(running, stalled);
  meshed_ = cone_gear_ = kNeutralGear;
  chain_.link = GearLink::open;
  now_ = {};
  energy_ = {};
  fresh_ = true;
  state_.engine_speed = speed_[engine_body];
  state_.shaft_speed = speed_[shaft_body];
  state_.road_speed = speed_[car_body];
  state_.running = running;
  state_.stalled = engine_.stalled();
  state_.fuel_cut = state_.cranking = false;
  state_.shudder = 0.0;
  state_.shift_advice = 0;
}

double Driveline::kinetic_energy() const noexcept {
  return gearshift::kinetic_energy(chain_, speed_);
}

void Driveline::step(const DrivelineInput& in, double seconds) noexcept {
  time_ = 0.0;
  length_ = seconds > 0.0 ? std::min(seconds, kLongestStep) : 0.0;
  take(in);
  if (!(length_ > 0.0)) settle_here();
  const double before = speed_[engine_body];
  while (time_ < length_) {
    const double next = std::min({length_, time_ + kLongestPiece, next_kink(time_)});
    advance(next - time_);
    time_ = next;
  }
  engine_.turn(0.5 * length_ * (before + speed_[engine_body]));
  show(clutch_capacity(car_.clutch, pedal_.to));
}

void Driveline::take(const DrivelineInput& in) noexcept {
  engine_.turn_key(in.ignition, in.starter);
  engine_.update(speed_[engine_body]);
  const bool same_cone = in.cone_gear == cone_gear_;
  mesh(in.meshed, in.cone_gear);
  state_.throttle = pedal(in.throttle);
  state_.brake = pedal(in.brake);
  state_.clutch = pedal(in.clutch);
  state_.hand_brake = pedal(in.hand_brake);
  state_.slope = finite(in.slope);
  state_.ignition = in.ignition;
  const BodySpec& body = car_.body;
  const auto go_to = [this](Ramp& ramp, double to, bool jump) {
    ramp.from = jump || fresh_ || !(length_ > 0.0) ? to : ramp.to;
    ramp.to = to;
  };
  go_to(throttle_, state_.throttle, false);
  go_to(pedal_, state_.clutch, false);
  go_to(brakes_, body.brake_force * state_.brake + body.hand_brake_force * state_.hand_brake, false);
  go_to(lift_, body.mass * kGravity * std::sin(state_.slope), false);
  const bool rubs = chain_.link == GearLink::cone;
  const double cone = rubs ? std::clamp(finite(in.cone_torque) / cone_ratio_, 0.0, kMostTorque) : 0.0;
  go_to(cone_, cone, !same_cone);
  fresh_ = false;
}

// Dogs that meet bring shaft and car to one speed. The clutch carries a limited torque, so none within no time: the
// engine goes on, and the clutch slips.
void Driveline::mesh(int gear, int cone_gear) noexcept {
  const double per_road = shaft_per_road(car_, gear), cone_per_road = shaft_per_road(car_, cone_gear);
  if (per_road == 0.0) {
    chain_.link = cone_per_road != 0.0 ? GearLink::cone : GearLink::open;
    chain_.per_road = cone_per_road;
    cone_ratio_ =
        cone_per_road != 0.0 ? std::abs(cone_per_road) * car_.body.wheel_radius / car_.gearbox.final_drive : 1.0;
  } else if (gear != meshed_) {
    chain_.link = GearLink::dogs;
    chain_.per_road = per_road;
    if (speed_[shaft_body] != per_road * speed_[car_body]) {
      const double before = kinetic_energy();
      speed_ = collide(chain_, speed_, {1, 0, {1, 1, 1}});
      energy_.mesh += before - kinetic_energy();
    }
  }
  meshed_ = per_road != 0.0 ? gear : kNeutralGear;
  cone_gear_ = cone_gear;
}

// The clutch's capacity has a kink where it begins to carry and where it carries all: a piece ends there.
double Driveline::next_kink(double after) const noexcept {
  double next = length_;
  if (pedal_.from == pedal_.to) return next;
  for (const double place : {car_.clutch.bite, car_.clutch.closed}) {
    const double at = length_ * (place - pedal_.from) / (pedal_.to - pedal_.from);
    if (at > after && at < next) next = at;
  }
  return next;
}

void Driveline::show(double capacity) noexcept {
  const ChainMotion& motion = now_.motion;
  const double engine = std::max(0.0, speed_[engine_body]);  // nor -0, where it was stopped from behind
  state_.engine_speed = engine;
  state_.engine_load = engine_.load(engine, state_.throttle);
  state_.engine_torque = engine_.torque(engine, state_.throttle) - friction_torque(car_.engine, engine);
  state_.running = engine_.running();
  state_.stalled = engine_.stalled();
  state_.over_revved = engine > car_.engine.red_line;
  state_.fuel_cut = engine_.fuel_cut();
  state_.cranking = engine_.cranks(engine);

  state_.clutch_capacity = capacity;
  state_.clutch_torque = motion.clutch;
  state_.shaft_speed = speed_[shaft_body];
  state_.slip_power = motion.clutch * (engine - state_.shaft_speed);
  state_.slip_energy = energy_.clutch;
  state_.clutch_locked = now_.mode.clutch == 0 && capacity > 0.0;
  state_.gear = meshed_;

  state_.road_speed = speed_[car_body];
  state_.acceleration = motion.rate[car_body];
  state_.drive_torque = motion.drive * car_.body.wheel_radius;

  state_.shudder = engine_shudder(car_.engine, state_);
  state_.shift_advice = shift_advice(car_, state_, state_.shift_advice);
}

}  // namespace gearshift
