// Motion within a step, split wherever a friction element or the engine changes state: each piece has one FrictionMode.
#include <algorithm>
#include <cmath>

#include "app/vehicle/driveline.h"

namespace gearshift::vehicle {
namespace {

constexpr double kEventTime = 1e-11;  // [s] accuracy of event location
constexpr int kMaxEvents = 20;        // per substep; impulses solve the rest, because events can accumulate (Zeno)

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

Driveline::Loads Driveline::loads_at(const PerBody& speed, double time) const noexcept {
  const double fraction = length_ > 0.0 ? time / length_ : 1.0;
  const double shaft = speed[shaft_body], road = speed[car_body];
  const BodySpec& body = car_.body;
  Loads loads;
  loads.lift = lift_.at(fraction);
  loads.brakes = brakes_.at(fraction);
  ChainLoads& chain = loads.chain;
  chain.push[engine_body] = engine_.torque(speed[engine_body], throttle_.at(fraction));
  chain.push[shaft_body] = -car_.gearbox.drag_slope * shaft;
  chain.push[car_body] = -(body.resistance_slope + body.resistance_square * std::abs(road)) * road - loads.lift;
  chain.ground[engine_body] = friction_torque(car_.engine, speed[engine_body]);
  chain.ground[shaft_body] = car_.gearbox.drag;
  chain.ground[car_body] = body.resistance + loads.brakes;
  chain.clutch = clutch_capacity(car_.clutch, pedal_.at(fraction));
  chain.cone = cone_.at(fraction);
  return loads;
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
  trial.loads = loads_at(half, time_ + 0.5 * seconds);
  trial.motion = motion_in_mode(chain_, trial.loads.chain, now_.mode);
  trial.speed = advance_speeds(chain_, now_.mode, speed_, trial.motion.rate, seconds);
  trial.ends_mode = reversed(trial.speed, trial.loads).any() || engine_.would_change(trial.speed[engine_body]);
  if (trial.ends_mode) return trial;
  const Loads at_end = loads_at(trial.speed, time_ + seconds);
  trial.end = {now_.mode, motion_in_mode(chain_, at_end.chain, now_.mode)};
  trial.ends_mode = trial.end.motion.violation > 0.0;
  return trial;
}

// Returns the elements whose slip speed or rotation has changed sign. Elements without friction are omitted, except the
// engine, which cannot turn backwards.
Driveline::Reversed Driveline::reversed(const PerBody& speed, const Loads& loads) const noexcept {
  const FrictionMode& mode = now_.mode;
  const ChainLoads& capacity = loads.chain;
  Reversed elements;
  elements.clutch = mode.clutch * (speed[engine_body] - speed[shaft_body]) < 0.0 && capacity.clutch > 0.0;
  elements.cone = mode.cone * cone_slip(chain_, speed) < 0.0 && capacity.cone > 0.0;
  for (std::size_t b = 0; b < 3; ++b)
    elements.turn[b] = mode.turn[b] * speed[b] < 0.0 && (b == engine_body || capacity.ground[b] > 0.0);
  return elements;
}

void Driveline::accept(const Trial& trial, double seconds) noexcept {
  account_energy(trial.loads, trial.motion, trial.speed, seconds);
  speed_ = trial.speed;
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
  now_ = solve_modes(chain_, loads_at(speed_, time_).chain, known, now_.mode);
}

// Impulse time stepping: loads and limits are held constant over the whole interval. All elements are solved together
// so that at the end of the interval each element sticks or slips against its full friction. The method is only
// first-order accurate, but always has a solution.
void Driveline::advance_by_impulses(double seconds) noexcept {
  ++fallbacks_;
  const Loads loads = loads_at(speed_, time_);
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
  energy_.clutch += motion.clutch * (distance[engine_body] - distance[shaft_body]);
  const double in_gear = motion.gear * distance[shaft_body] - motion.drive * distance[car_body];
  (chain_.link == GearLink::cone ? energy_.cone : energy_.teeth) += in_gear;
  energy_.shaft_drag -= (chain.push[shaft_body] + motion.ground[shaft_body]) * distance[shaft_body];
  energy_.rolling -= (chain.push[car_body] + loads.lift) * distance[car_body] + (1.0 - by_brakes) * held;
  energy_.brakes -= by_brakes * held;
  energy_.slope += loads.lift * distance[car_body];
  state_.distance += distance[car_body];
}

}  // namespace gearshift::vehicle
