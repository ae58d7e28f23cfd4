// Reads the inputs of a step and publishes the state after it. The motion itself is computed in driveline_motion.cpp.
#include "app/vehicle/driveline.h"

#include <algorithm>
#include <cmath>

#include "app/vehicle/engine_shudder.h"
#include "app/vehicle/shift_advice.h"

namespace gearshift::vehicle {
namespace {

constexpr double kMaxStep = 0.5;       // [s]
constexpr double kMaxSubstep = 0.002;  // [s] longest step of the midpoint rule
constexpr double kGravity = 9.81;      // [m/s^2]
// [N m] Largest torque of one friction element. It brings a clutch disc of usual inertia to the engine's speed within
// 0.1 ms.
constexpr double kMaxTorque = 1e5;

double finite(double value) noexcept {
  return std::isfinite(value) ? value : 0.0;
}

double pedal(double value) noexcept {
  return std::clamp(finite(value), 0.0, 1.0);
}

}  // namespace

double clutch_capacity(const ClutchSpec& clutch, double pedal) noexcept {
  if (pedal >= clutch.bite) return 0.0;
  if (pedal <= clutch.closed) return clutch.capacity;
  const double fraction = (clutch.bite - pedal) / (clutch.bite - clutch.closed);
  return clutch.capacity * fraction * fraction;
}

Driveline::Driveline(const CarSpec& car) : car_(car), engine_(car.engine) {
  car_.clutch.capacity = std::min(car.clutch.capacity, kMaxTorque);
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
  meshed_ = cone_gear_ = haptics::kNeutralGear;
  chain_.link = GearLink::open;
  now_ = {};
  energy_ = {};
  is_first_step_ = true;
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
  return vehicle::kinetic_energy(chain_, speed_);
}

void Driveline::step(const DrivelineInput& in, double seconds) noexcept {
  time_ = 0.0;
  length_ = seconds > 0.0 ? std::min(seconds, kMaxStep) : 0.0;
  set_input(in);
  if (!(length_ > 0.0)) update_modes();
  const double before = speed_[engine_body];
  while (time_ < length_) {
    const double next = std::min({length_, time_ + kMaxSubstep, next_kink(time_)});
    advance(next - time_);
    time_ = next;
  }
  engine_.add_crank_angle(0.5 * length_ * (before + speed_[engine_body]));
  publish_state(clutch_capacity(car_.clutch, pedal_.to));
}

void Driveline::set_input(const DrivelineInput& in) noexcept {
  engine_.turn_key(in.ignition, in.starter);
  engine_.update(speed_[engine_body]);
  const bool same_cone = in.cone_gear == cone_gear_;
  mesh(in.meshed, in.cone_gear);
  state_.pedals.throttle = pedal(in.pedals.throttle);
  state_.pedals.brake = pedal(in.pedals.brake);
  state_.pedals.clutch = pedal(in.pedals.clutch);
  state_.pedals.hand_brake = pedal(in.pedals.hand_brake);
  state_.slope = finite(in.slope);
  state_.ignition = in.ignition;
  const BodySpec& body = car_.body;
  const auto go_to = [this](Ramp& ramp, double to, bool jump) {
    ramp.from = jump || is_first_step_ || !(length_ > 0.0) ? to : ramp.to;
    ramp.to = to;
  };
  go_to(throttle_, state_.pedals.throttle, false);
  go_to(pedal_, state_.pedals.clutch, false);
  go_to(brakes_, body.brake_force * state_.pedals.brake + body.hand_brake_force * state_.pedals.hand_brake, false);
  go_to(lift_, body.mass * kGravity * std::sin(state_.slope), false);
  const bool rubs = chain_.link == GearLink::cone;
  const double cone = rubs ? std::clamp(finite(in.cone_torque) / cone_ratio_, 0.0, kMaxTorque) : 0.0;
  go_to(cone_, cone, !same_cone);
  is_first_step_ = false;
}

// Connects shaft and car by the dogs of `gear`. If `gear` is neutral, connects them by the cone of `cone_gear`.
// Engaging dogs bring shaft and car to one speed at once. The clutch's torque is limited, so it transmits no impulse:
// the engine keeps its speed and the clutch slips.
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
  meshed_ = per_road != 0.0 ? gear : haptics::kNeutralGear;
  cone_gear_ = cone_gear;
}

// Returns the time of the next kink in the clutch capacity, where the moving pedal passes the bite point or the point
// of full capacity. A substep ends at each kink.
double Driveline::next_kink(double after) const noexcept {
  double next = length_;
  if (pedal_.from == pedal_.to) return next;
  for (const double place : {car_.clutch.bite, car_.clutch.closed}) {
    const double at = length_ * (place - pedal_.from) / (pedal_.to - pedal_.from);
    if (at > after && at < next) next = at;
  }
  return next;
}

void Driveline::publish_state(double capacity) noexcept {
  const ChainMotion& motion = now_.motion;
  // Changes -0 to 0: when the car stops the engine, the computed speed can be -0.
  const double engine = std::max(0.0, speed_[engine_body]);
  state_.engine_speed = engine;
  state_.engine_load = engine_.load(engine, state_.pedals.throttle);
  state_.running = engine_.running();
  state_.stalled = engine_.stalled();
  state_.over_revved = engine > car_.engine.red_line;
  state_.fuel_cut = engine_.fuel_cut();
  state_.cranking = engine_.is_cranking_at(engine);

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

}  // namespace gearshift::vehicle
