// How the chain moves within a step: pieces of one mode each, cut where a grip or the engine changes.
#include <algorithm>
#include <cmath>

#include "app/vehicle/driveline.h"

namespace gearshift {
namespace {

constexpr double kEventTime = 1e-11;  // [s] within which a change is located
constexpr int kMostEvents = 20;       // in a piece; then impulses (Zeno)

// Speeds `seconds` on; what moves as one has one speed, to the bit.
PerBody moved(const GripChain& chain, const GripMode& mode, const PerBody& from, const PerBody& rate,
              double seconds) noexcept {
  PerBody to;
  for (std::size_t b = 0; b < 3; ++b) to[b] = from[b] + seconds * rate[b];
  if (gear_holds(chain, mode)) to[shaft_body] = chain.per_road * to[car_body];
  if (mode.clutch == 0) to[engine_body] = to[shaft_body];
  return to;
}

}  // namespace

Driveline::Loads Driveline::loads_at(const PerBody& speed, double time) const noexcept {
  const double share = length_ > 0.0 ? time / length_ : 1.0;
  const double shaft = speed[shaft_body], road = speed[car_body];
  const BodySpec& body = car_.body;
  Loads loads;
  loads.lift = lift_.at(share);
  loads.brakes = brakes_.at(share);
  ChainLoads& chain = loads.chain;
  chain.push[engine_body] = engine_.torque(speed[engine_body], throttle_.at(share));
  chain.push[shaft_body] = -car_.gearbox.drag_slope * shaft;
  chain.push[car_body] = -(body.resistance_slope + body.resistance_square * std::abs(road)) * road - loads.lift;
  chain.ground[engine_body] = friction_torque(car_.engine, speed[engine_body]);
  chain.ground[shaft_body] = car_.gearbox.drag;
  chain.ground[car_body] = body.resistance + loads.brakes;
  chain.clutch = clutch_capacity(car_.clutch, pedal_.at(share));
  chain.cone = cone_.at(share);
  return loads;
}

void Driveline::advance(double seconds) noexcept {
  const double end = time_ + seconds;
  settle_here();
  for (int events = 0; time_ < end; ++events) {
    double left = end - time_;
    if (events > kMostEvents) {
      advance_by_impulses(left);
      return;
    }
    Trial trial = tried(left);
    if (trial.changes) {
      double before = 0.0;
      while (left - before > kEventTime) {
        const double middle = 0.5 * (before + left);
        const Trial shorter = tried(middle);
        if (shorter.changes) {
          left = middle;
          trial = shorter;
        } else {
          before = middle;
        }
      }
    }
    accept(trial, left);
    time_ = trial.changes ? time_ + left : end;
    if (trial.changes) {
      snap(reversed(speed_, trial.loads));
      engine_.update(speed_[engine_body]);
      settle_here();
    }
  }
}

// Midpoint rule in the present mode. The trial says whether the mode ends on the way.
Driveline::Trial Driveline::tried(double seconds) const noexcept {
  Trial trial;
  const PerBody half = moved(chain_, now_.mode, speed_, now_.motion.rate, 0.5 * seconds);
  trial.loads = loads_at(half, time_ + 0.5 * seconds);
  trial.motion = move(chain_, trial.loads.chain, now_.mode);
  trial.speed = moved(chain_, now_.mode, speed_, trial.motion.rate, seconds);
  trial.changes = reversed(trial.speed, trial.loads).any() || engine_.would_change(trial.speed[engine_body]);
  if (trial.changes) return trial;
  const Loads at_end = loads_at(trial.speed, time_ + seconds);
  trial.end = {now_.mode, move(chain_, at_end.chain, now_.mode)};
  trial.changes = trial.end.motion.lacks > 0.0;
  return trial;
}

// Which grips have come to the other side of rest? One without capacity does so and nothing happens.
Driveline::Reversed Driveline::reversed(const PerBody& speed, const Loads& loads) const noexcept {
  const GripMode& mode = now_.mode;
  const ChainLoads& most = loads.chain;
  Reversed is;
  is.clutch = mode.clutch * (speed[engine_body] - speed[shaft_body]) < 0.0 && most.clutch > 0.0;
  is.cone = mode.cone * cone_slip(chain_, speed) < 0.0 && most.cone > 0.0;
  for (std::size_t b = 0; b < 3; ++b)
    is.turn[b] = mode.turn[b] * speed[b] < 0.0 && (b == engine_body || most.ground[b] > 0.0);
  return is;
}

void Driveline::accept(const Trial& trial, double seconds) noexcept {
  book(trial.loads, trial.motion, trial.speed, seconds);
  speed_ = trial.speed;
  if (!trial.changes) now_ = trial.end;
}

// What has come to rest, or to one speed, within the time of the event does so to the bit. The energy of what little
// speed is left after 10 ps is below rounding.
void Driveline::snap(const Reversed& is) noexcept {
  if (!is.any()) return;
  GripMode& mode = now_.mode;
  if (is.clutch) mode.clutch = 0;
  if (is.cone) mode.cone = 0;
  for (std::size_t b = 0; b < 3; ++b)
    if (is.turn[b]) mode.turn[b] = 0;
  speed_ = collide(chain_, speed_, mode);
}

// Which grips hold from here on. One that slips is known by its sign, the others must be found.
void Driveline::settle_here() noexcept {
  GripMode known;
  known.clutch = sign(speed_[engine_body] - speed_[shaft_body]);
  known.cone = sign(cone_slip(chain_, speed_));
  for (std::size_t b = 0; b < 3; ++b) known.turn[b] = sign(speed_[b]);
  now_ = settle(chain_, loads_at(speed_, time_).chain, known, now_.mode);
}

// Time stepping: loads and limits of the moment over the whole time, and all grips solved together so that each holds
// at its end, or slips in the direction of its force. First order, but nothing can make it fail.
void Driveline::advance_by_impulses(double seconds) noexcept {
  ++fallbacks_;
  const Loads loads = loads_at(speed_, time_);
  ChainLoads with_momentum = loads.chain;
  for (std::size_t b = 0; b < 3; ++b) with_momentum.push[b] += chain_.inertia[b] * speed_[b] / seconds;
  now_ = settle(chain_, with_momentum, {}, now_.mode);
  PerBody to;
  for (std::size_t b = 0; b < 3; ++b) to[b] = seconds * now_.motion.rate[b];
  book(loads, now_.motion, to, seconds);
  speed_ = to;
  time_ += seconds;
  engine_.update(speed_[engine_body]);
  settle_here();
}

// Force times time times mean speed: with the momentum that the same forces gave, the balance is exact.
void Driveline::book(const Loads& loads, const ChainMotion& motion, const PerBody& to, double seconds) noexcept {
  PerBody way;
  for (std::size_t b = 0; b < 3; ++b) way[b] = 0.5 * seconds * (speed_[b] + to[b]);
  const ChainLoads& chain = loads.chain;
  const double held = motion.ground[car_body] * way[car_body];
  const double by_brakes = chain.ground[car_body] > 0.0 ? loads.brakes / chain.ground[car_body] : 0.0;
  energy_.engine += chain.push[engine_body] * way[engine_body];
  energy_.friction -= motion.ground[engine_body] * way[engine_body];
  energy_.clutch += motion.clutch * (way[engine_body] - way[shaft_body]);
  const double in_gear = motion.gear * way[shaft_body] - motion.drive * way[car_body];
  (chain_.link == GearLink::cone ? energy_.cone : energy_.teeth) += in_gear;
  energy_.shaft_drag -= (chain.push[shaft_body] + motion.ground[shaft_body]) * way[shaft_body];
  energy_.rolling -= (chain.push[car_body] + loads.lift) * way[car_body] + (1.0 - by_brakes) * held;
  energy_.brakes -= by_brakes * held;
  energy_.slope += loads.lift * way[car_body];
  state_.distance += way[car_body];
}

}  // namespace gearshift
