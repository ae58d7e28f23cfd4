// This work is based on:
// Erin Catto. Iterative Dynamics with Temporal Coherence. 2005
#include "app/vehicle/rolling_car.h"

#include <algorithm>
#include <cmath>

namespace gearshift {
namespace {

constexpr double kLongestStep = 0.002;  // [s]
constexpr double kLongestCall = 0.25;   // [s]
constexpr double kGravity = 9.81;       // [m/s^2]
constexpr double kAirDensity = 1.225;   // [kg/m^3] standard atmosphere at sea level, 15 C

constexpr double kPeakAt = 0.55;          // [1] of the limiter: the speed of the largest torque
constexpr double kFrictionAtRest = 0.4;   // [1] of friction_torque
constexpr double kStallsBelow = 0.42;     // [1] of idle
constexpr double kFiresAbove = 0.3;       // [1] of idle, with the starter
constexpr double kStarterTorque = 60.0;   // [N m] at rest
constexpr double kStarterSpeed = 0.6;     // [1] of idle: the starter turns no faster
constexpr double kIdleGain = 2.0;         // [N m s] of the idle control
constexpr double kIdleThrottle = 0.35;    // [1] the most that it opens
constexpr double kLimiterBand = 0.02;     // [1] of the limiter, in which it closes the throttle
constexpr double kClutchFrees = 0.5;      // [1] pedal: from here on the gearbox' shaft is free
constexpr double kDogsMeetWithin = 10.0;  // [rad/s] at the clutch's shaft

double pedal(double value) noexcept {
  return value > 0.0 ? std::min(value, 1.0) : 0.0;  // what is no number is 0
}

// A force between two masses that wants their speeds equal (friction, a clutch that holds), as an impulse over a step.
// Sequential impulses: each adds what it lacks to what it has given so far, within its limits, until all agree.
struct Grip {
  double low, high;    // [N m s] or [N s] within which its impulse stays
  double given = 0.0;  // so far

  double add(double lacking) noexcept {
    const double before = given;
    given = std::clamp(given + lacking, low, high);
    return given - before;
  }
  bool holds() const noexcept { return given > low && given < high; }
};
constexpr int kRounds = 12;  // each leaves at most the share Je / (Je + Jc) of what the round before left

}  // namespace

double full_torque(const RollingCarConfig& config, double engine_speed) noexcept {
  const double off = engine_speed / (kPeakAt * config.limiter) - 1.0;
  return config.peak_torque * std::max(0.0, 1.0 - 0.5 * off * off);
}

double friction_torque(const RollingCarConfig& config, double engine_speed) noexcept {
  return config.friction_torque * (kFrictionAtRest + (1.0 - kFrictionAtRest) * engine_speed / config.limiter);
}

RollingCar::RollingCar(const RollingCarConfig& config) : config_(config) {
  state_.engine_speed = config.idle;
  state_.road_speed = config.start_speed;
}

void RollingCar::step(const DriverControls& controls, int gear, double seconds) noexcept {
  take(controls, gear);
  if (!(seconds > 0.0)) return;
  seconds = std::min(seconds, kLongestCall);
  const int steps = static_cast<int>(std::ceil(seconds / kLongestStep));
  for (int i = 0; i < steps; ++i) {
    mesh();
    run_engine();
    move(seconds / steps);
  }
}

void RollingCar::take(const DriverControls& controls, int gear) noexcept {
  state_.throttle = pedal(controls.throttle);
  state_.brake = pedal(controls.brake);
  state_.clutch = pedal(controls.clutch);
  state_.hand_brake = pedal(controls.hand_brake);
  state_.ignition = controls.ignition;
  starter_ = controls.ignition && controls.starter;
  const int known = std::clamp(gear, kReverseGear, kMaxGear);
  if (known != state_.gear) meshed_ = known == kNeutralGear;
  state_.gear = known;
}

double RollingCar::shaft_per_road() const noexcept {
  if (state_.gear == kNeutralGear || !meshed_) return 0.0;
  const double ratio =
      state_.gear == kReverseGear ? -config_.reverse_ratio : config_.ratio[static_cast<std::size_t>(state_.gear - 1)];
  return ratio * config_.final_drive / config_.wheel_radius;
}

double RollingCar::clutch_torque() const noexcept {
  return config_.clutch_capacity * (1.0 - state_.clutch);
}

// Dogs go in when their speeds meet, and rattle until then. A forward gear has a synchroniser, which turns a free shaft
// to any speed but cannot turn the engine; reverse has none, its free shaft stands.
void RollingCar::mesh() noexcept {
  if (!meshed_) {
    meshed_ = true;
    const double wanted = shaft_per_road() * state_.road_speed;
    const bool free = state_.clutch >= kClutchFrees;
    const bool synchronised = free && state_.gear != kReverseGear;
    const double has = free ? 0.0 : state_.engine_speed;
    meshed_ = synchronised || std::abs(wanted - has) <= kDogsMeetWithin;
  }
  state_.grinding = !meshed_;
}

void RollingCar::run_engine() noexcept {
  const double speed = state_.engine_speed / config_.idle;
  if (!state_.ignition || speed < kStallsBelow) runs_ = false;
  if (starter_ && speed > kFiresAbove) runs_ = true;
  state_.stalled = state_.ignition && !runs_;
}

// Of combustion and starter, friction taken off. The idle control gives back the friction and pulls towards idle; the
// pedal takes over where it asks for more.
double RollingCar::engine_torque() noexcept {
  const double speed = state_.engine_speed;
  const double friction = friction_torque(config_, speed);
  const double full = full_torque(config_, speed);
  state_.engine_load = 0.0;
  if (runs_ && full > 0.0) {
    const double idling = std::clamp((friction + kIdleGain * (config_.idle - speed)) / full, 0.0, kIdleThrottle);
    const double cut = std::clamp((config_.limiter - speed) / (kLimiterBand * config_.limiter), 0.0, 1.0);
    state_.engine_load = std::max(state_.throttle, idling) * cut;
  }
  const double cranking = 1.0 - speed / (kStarterSpeed * config_.idle);
  return state_.engine_load * full - friction + (starter_ ? kStarterTorque * std::max(0.0, cranking) : 0.0);
}

// Engine (inertia J_e, speed w) and car (mass m, speed v); the clutch's shaft turns at G v.
//     J_e w' = T_e - T_c              |T_c| <= capacity, holding w = G v where it can
//     m v'   = G T_c - k v |v| - F    |F| <= rolling resistance and brakes, holding v = 0 where it can
// Clutch, brakes and the engine's refusal to turn backwards (w >= 0) are solved as impulses of one step: what locks,
// locks with its momentum conserved, and what stands, stands still.
void RollingCar::move(double seconds) noexcept {
  const double ratio = shaft_per_road();
  const double engine = 1.0 / config_.engine_inertia, car = 1.0 / config_.mass;
  const double drag = 0.5 * kAirDensity * config_.drag_area;
  double w = std::max(0.0, state_.engine_speed + seconds * engine * engine_torque());  // friction stops, no more
  double v = state_.road_speed - seconds * car * drag * state_.road_speed * std::abs(state_.road_speed);

  const double carries = ratio != 0.0 ? seconds * clutch_torque() : 0.0;
  const double holds = seconds * (config_.rolling * config_.mass * kGravity + config_.brake_force * state_.brake +
                                  config_.hand_brake_force * state_.hand_brake);
  Grip clutch{-carries, carries}, brakes{-holds, holds}, one_way{0.0, HUGE_VAL};
  for (int round = 0; round < kRounds; ++round) {
    const double slip = clutch.add((w - ratio * v) / (engine + ratio * ratio * car));
    w -= engine * slip;
    v += car * ratio * slip;
    v += car * brakes.add(-v / car);
    w += engine * one_way.add(-w / engine);
  }
  if (brakes.holds()) v = 0.0;  // to the bit: nothing creeps by rounding
  if (one_way.holds()) w = 0.0;
  state_.distance += 0.5 * seconds * (state_.road_speed + v);
  state_.engine_speed = w;
  state_.road_speed = v;
}

}  // namespace gearshift
