// A step reads its inputs, moves the bodies, and publishes the state. The motion within a step is split wherever a
// friction element or the engine changes state: each piece has one FrictionMode.
#include "app/vehicle/driveline.h"

#include <algorithm>
#include <cmath>

#include "app/vehicle/engine_shudder.h"
#include "app/vehicle/shift_advice.h"

namespace gearshift::vehicle {
namespace {

constexpr double kMaxStep = 0.5;       // [s]
constexpr double kMaxSubstep = 0.002;  // [s] longest step of the midpoint rule
// [s] The same for an engine that turns so slowly that its compression changes steeply.
constexpr double kMaxCompressedSubstep = 2.5e-4;
constexpr double kGravity = 9.81;  // [m/s^2]
// [N m] Largest torque of one friction element. It brings a clutch disc of usual inertia to the engine's speed within
// 0.1 ms.
constexpr double kMaxTorque = 1e5;
constexpr double kEventTime = 1e-11;  // [s] accuracy of event location
constexpr int kMaxEvents = 20;        // per substep; impulses solve the rest, because events can accumulate (Zeno)

double finite(double value) noexcept {
  return std::isfinite(value) ? value : 0.0;
}

double pedal(double value) noexcept {
  return std::clamp(finite(value), 0.0, 1.0);
}

// Speeds after `seconds`. Bodies that stick together get exactly matching speeds.
PerBody advance_speeds(const FrictionChain& chain, const FrictionMode& mode, const PerBody& from, const PerBody& rate,
                       double seconds) noexcept {
  PerBody to;
  for (std::size_t b = 0; b < 3; ++b) to[b] = from[b] + seconds * rate[b];
  if (gear_holds(chain, mode)) to[shaft_body] = chain.per_road * to[car_body];
  if (mode.clutch == 0) to[engine_body] = to[shaft_body];
  return to;
}

}  // namespace

double clutch_capacity(const ClutchSpec& clutch, double pedal) noexcept {
  if (pedal >= clutch.bite) return 0.0;
  if (pedal <= clutch.closed) return clutch.capacity;
  const double fraction = (clutch.bite - pedal) / (clutch.bite - clutch.closed);
  return clutch.capacity * fraction * fraction;
}

double clutch_fade(double temperature) noexcept {
  return std::clamp((kClutchBurnt - temperature) / (kClutchBurnt - kClutchFades), 0.0, 1.0);
}

Driveline::Driveline(const CarSpec& car) : car_(car), engine_(car.engine) {
  car_.clutch.capacity = std::min(car.clutch.capacity, kMaxTorque);
  chain_.inertia = {car.engine.inertia, car.clutch.disc_inertia, car.body.mass + car.body.rotating};
  chain_.efficiency = car.gearbox.efficiency;
  state_.red_line = car.engine.red_line;
  state_.top_speed = top_speed(car);
  state_.speed_unit = car.speed_unit;
  state_.clutch_bite = car.clutch.bite;
  state_.clutch_closed = car.clutch.closed;
  place(car.engine.idle, 0.0, 0.0, true);
}

void Driveline::place(double engine_speed, double shaft_speed, double road_speed, bool running, bool stalled,
                      const EngineState& engine, double clutch_temperature) noexcept {
  speed_ = {finite(engine_speed), finite(shaft_speed), finite(road_speed)};
  engine_.set(running, stalled);
  engine_.set_state(engine);
  temperature_ = state_.clutch_temperature = finite(clutch_temperature);
  heating_ = 0.0;
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
  state_.idle_integral = engine_.state().integral;
  state_.idle_lift = engine_.state().lift;
  state_.cranked = engine_.state().cranked;
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
  while (time_ < length_) {
    const double next = std::min({length_, time_ + max_substep(), next_kink(time_)});
    advance(next - time_);
    time_ = next;
  }
  publish_state(clutch_capacity(car_.clutch, pedal_.to) * clutch_fade(temperature_));
}

double Driveline::max_substep() const noexcept {
  const bool is_slow = speed_[engine_body] != 0.0 && std::abs(speed_[engine_body]) < kMaxCompressedSpeed;
  return is_slow && car_.engine.compression > 0.0 ? kMaxCompressedSubstep : kMaxSubstep;
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

Driveline::Loads Driveline::loads_at(const PerBody& speed, double time, const EngineState& engine) const noexcept {
  const double fraction = length_ > 0.0 ? time / length_ : 1.0;
  const double shaft = speed[shaft_body], road = speed[car_body];
  const BodySpec& body = car_.body;
  Loads loads;
  loads.lift = lift_.at(fraction);
  loads.brakes = brakes_.at(fraction);
  ChainLoads& chain = loads.chain;
  chain.push[engine_body] = engine_.torque(speed[engine_body], throttle_.at(fraction), engine);
  chain.push[shaft_body] = -car_.gearbox.drag_slope * shaft;
  chain.push[car_body] = -(body.resistance_slope + body.resistance_square * std::abs(road)) * road - loads.lift;
  chain.ground[engine_body] = friction_torque(car_.engine, speed[engine_body]);
  chain.ground[shaft_body] = car_.gearbox.drag;
  chain.ground[car_body] = body.resistance + loads.brakes;
  const double temperature = temperature_ + heating_ * (time - time_);
  chain.clutch = clutch_capacity(car_.clutch, pedal_.at(fraction)) * clutch_fade(temperature);
  chain.cone = cone_.at(fraction);
  return loads;
}

// The engine control's state `seconds` after the present one, if its rate is that of this speed, these loads and `at`.
EngineState Driveline::engine_after(double seconds, const PerBody& speed, const Loads& loads,
                                    const EngineState& at) const noexcept {
  const double slip_torque = now_.mode.clutch > 0 ? loads.chain.clutch : 0.0;
  const EngineState rate = engine_.state_rate(speed[engine_body], slip_torque, at);
  const EngineState& now = engine_.state();
  return {now.integral + seconds * rate.integral, now.lift + seconds * rate.lift, now.cranked + seconds * rate.cranked};
}

void Driveline::advance(double seconds) noexcept {
  const double end = time_ + seconds;
  update_modes();
  for (int events = 0; time_ < end; ++events) {
    double left = end - time_;
    if (events > kMaxEvents) {
      advance_by_impulses(left);
      return;
    }
    Trial trial = try_step(left);
    if (trial.ends_mode) {
      double before = 0.0;
      while (left - before > kEventTime) {
        const double middle = 0.5 * (before + left);
        const Trial shorter = try_step(middle);
        if (shorter.ends_mode) {
          left = middle;
          trial = shorter;
        } else {
          before = middle;
        }
      }
    }
    accept(trial, left);
    time_ = trial.ends_mode ? time_ + left : end;
    if (trial.ends_mode) {
      snap(reversed(speed_, trial.loads));
      engine_.update(speed_[engine_body]);
      update_modes();
    }
  }
}

// Tries a step of the midpoint rule in the current mode. Trial::ends_mode is true if the mode ends during the step.
Driveline::Trial Driveline::try_step(double seconds) const noexcept {
  Trial trial;
  const PerBody half = advance_speeds(chain_, now_.mode, speed_, now_.motion.rate, 0.5 * seconds);
  const EngineState engine_half = engine_after(0.5 * seconds, speed_, present_loads(), engine_.state());
  trial.loads = loads_at(half, time_ + 0.5 * seconds, engine_half);
  trial.motion = motion_in_mode(chain_, trial.loads.chain, now_.mode);
  trial.speed = advance_speeds(chain_, now_.mode, speed_, trial.motion.rate, seconds);
  trial.engine = engine_after(seconds, half, trial.loads, engine_half);
  trial.ends_mode =
      reversed(trial.speed, trial.loads).any() || engine_.would_change(trial.speed[engine_body], trial.engine);
  if (trial.ends_mode) return trial;
  const Loads at_end = loads_at(trial.speed, time_ + seconds, trial.engine);
  trial.end = {now_.mode, motion_in_mode(chain_, at_end.chain, now_.mode)};
  trial.ends_mode = trial.end.motion.violation > 0.0;
  return trial;
}

// Returns the elements whose slip speed or rotation has changed sign. Elements without friction are omitted.
Driveline::Reversed Driveline::reversed(const PerBody& speed, const Loads& loads) const noexcept {
  const FrictionMode& mode = now_.mode;
  const ChainLoads& capacity = loads.chain;
  Reversed elements;
  elements.clutch = mode.clutch * (speed[engine_body] - speed[shaft_body]) < 0.0 && capacity.clutch > 0.0;
  elements.cone = mode.cone * cone_slip(chain_, speed) < 0.0 && capacity.cone > 0.0;
  for (std::size_t b = 0; b < 3; ++b) elements.turn[b] = mode.turn[b] * speed[b] < 0.0 && capacity.ground[b] > 0.0;
  return elements;
}

void Driveline::accept(const Trial& trial, double seconds) noexcept {
  account_energy(trial.loads, trial.motion, trial.speed, seconds);
  speed_ = trial.speed;
  engine_.set_state(trial.engine);
  if (!trial.ends_mode) now_ = trial.end;
}

// Makes elements that stop slipping within the event tolerance stick exactly. The removed slip speed is what builds up
// in at most 10 ps, so its kinetic energy is below rounding.
void Driveline::snap(const Reversed& elements) noexcept {
  if (!elements.any()) return;
  FrictionMode& mode = now_.mode;
  if (elements.clutch) mode.clutch = 0;
  if (elements.cone) mode.cone = 0;
  for (std::size_t b = 0; b < 3; ++b)
    if (elements.turn[b]) mode.turn[b] = 0;
  speed_ = collide(chain_, speed_, mode);
}

// Finds which elements stick from now on. An element that already slips keeps slipping in the same direction; the modes
// of the other elements are solved for.
void Driveline::update_modes() noexcept {
  FrictionMode known;
  known.clutch = sign(speed_[engine_body] - speed_[shaft_body]);
  known.cone = sign(cone_slip(chain_, speed_));
  for (std::size_t b = 0; b < 3; ++b) known.turn[b] = sign(speed_[b]);
  now_ = solve_modes(chain_, present_loads().chain, known, now_.mode);
}

// Impulse time stepping: loads and limits are held constant over the whole interval. All elements are solved together
// so that at the end of the interval each element sticks or slips against its full friction. The method is only
// first-order accurate, but always has a solution.
void Driveline::advance_by_impulses(double seconds) noexcept {
  ++fallbacks_;
  const Loads loads = present_loads();
  engine_.set_state(engine_after(seconds, speed_, loads, engine_.state()));
  ChainLoads with_momentum = loads.chain;
  for (std::size_t b = 0; b < 3; ++b) with_momentum.push[b] += chain_.inertia[b] * speed_[b] / seconds;
  now_ = solve_modes(chain_, with_momentum, {}, now_.mode);
  PerBody to;
  for (std::size_t b = 0; b < 3; ++b) to[b] = seconds * now_.motion.rate[b];
  account_energy(loads, now_.motion, to, seconds);
  speed_ = to;
  time_ += seconds;
  engine_.update(speed_[engine_body]);
  update_modes();
}

// Energy is force times time times mean speed. The same forces changed the momentum, so the energy balance is exact.
void Driveline::account_energy(const Loads& loads, const ChainMotion& motion, const PerBody& to,
                               double seconds) noexcept {
  PerBody distance;
  for (std::size_t b = 0; b < 3; ++b) distance[b] = 0.5 * seconds * (speed_[b] + to[b]);
  const ChainLoads& chain = loads.chain;
  const double held = motion.ground[car_body] * distance[car_body];
  const double by_brakes = chain.ground[car_body] > 0.0 ? loads.brakes / chain.ground[car_body] : 0.0;
  energy_.engine += chain.push[engine_body] * distance[engine_body];
  energy_.friction -= motion.ground[engine_body] * distance[engine_body];
  const double slip_heat = motion.clutch * (distance[engine_body] - distance[shaft_body]);
  energy_.clutch += slip_heat;
  heat_clutch(slip_heat, seconds);
  const double in_gear = motion.gear * distance[shaft_body] - motion.drive * distance[car_body];
  (chain_.link == GearLink::cone ? energy_.cone : energy_.teeth) += in_gear;
  energy_.shaft_drag -= (chain.push[shaft_body] + motion.ground[shaft_body]) * distance[shaft_body];
  energy_.rolling -= (chain.push[car_body] + loads.lift) * distance[car_body] + (1.0 - by_brakes) * held;
  energy_.brakes -= by_brakes * held;
  energy_.slope += loads.lift * distance[car_body];
  state_.distance += distance[car_body];
}

// The clutch as one mass that cools to the air around it: C dT/dt = P - k (T - T_air), by the midpoint rule.
void Driveline::heat_clutch(double heat, double seconds) noexcept {
  const ClutchSpec& clutch = car_.clutch;
  if (!(seconds > 0.0)) return;
  const double cooled = clutch.cooling * (temperature_ - kAirTemperature) * seconds;
  const double rise = (heat - cooled) / (clutch.heat_capacity + 0.5 * clutch.cooling * seconds);
  temperature_ += rise;
  heating_ = rise / seconds;
}

void Driveline::publish_state(double capacity) noexcept {
  const ChainMotion& motion = now_.motion;
  const double engine = speed_[engine_body] + 0.0;  // changes -0 to 0
  state_.engine_speed = engine;
  state_.engine_load = engine_.load(engine, state_.pedals.throttle);
  state_.running = engine_.running();
  state_.stalled = engine_.stalled();
  state_.over_revved = engine > car_.engine.red_line;
  state_.fuel_cut = engine_.fuel_cut();
  state_.cranking = engine_.is_cranking_at(engine);
  state_.idle_integral = engine_.state().integral;
  state_.idle_lift = engine_.state().lift;
  state_.cranked = engine_.state().cranked;

  state_.clutch_capacity = capacity;
  state_.clutch_torque = motion.clutch;
  state_.shaft_speed = speed_[shaft_body];
  state_.slip_power = motion.clutch * (engine - state_.shaft_speed);
  state_.slip_energy = energy_.clutch;
  state_.clutch_temperature = temperature_;
  state_.clutch_smells = temperature_ > kClutchSmells;
  state_.clutch_fades = temperature_ > kClutchFades;
  state_.clutch_locked = now_.mode.clutch == 0 && capacity > 0.0;
  state_.gear = meshed_;

  state_.road_speed = speed_[car_body];
  state_.acceleration = motion.rate[car_body];
  state_.drive_torque = motion.drive * car_.body.wheel_radius;

  state_.shudder = engine_shudder(car_.engine, state_);
  state_.shift_advice = shift_advice(car_, state_, state_.shift_advice);
}

}  // namespace gearshift::vehicle
