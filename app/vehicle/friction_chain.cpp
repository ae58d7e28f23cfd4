#include "app/vehicle/friction_chain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gearshift::vehicle {
namespace {

constexpr double kSlack = 1e-12;  // [1] tolerance relative to the forces, so that rounding does not cause slip
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Distance of `force` from the range [low, high], 0 inside it.
double distance_outside(double force, double low, double high) noexcept {
  const double by = std::max(low - force, force - high);
  return by > 0.0 ? std::max(0.0, by - kSlack * (std::abs(force) + std::abs(force < low ? low : high))) : 0.0;
}

// Clutch and gear as arrays. Link i joins bodies i and i + 1. While link i sticks, the speed of body i is ratio[i]
// times the speed of body i + 1.
struct Links {
  std::array<bool, 2> is_holding;
  std::array<double, 2> ratio, limit;
  std::array<double, 2> torque{};  // measured at body i
};

Links make_links(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& mode) noexcept {
  const bool dogs = chain.link == GearLink::dogs, cone = chain.link == GearLink::cone;
  Links links{{mode.clutch == 0, gear_holds(chain, mode)}, {1.0, chain.per_road}, {loads.clutch, loads.cone}, {}};
  if (dogs) links.limit[1] = kNoLimit;
  if (!links.is_holding[0]) links.torque[0] = mode.clutch * loads.clutch;
  if (cone && mode.cone != 0) links.torque[1] = mode.cone * loads.cone;
  return links;
}

struct Segment {
  std::size_t first, last;     // first and last of the bodies that move as one
  double force_in, force_out;  // [N m] or [N] force on the first body; force passed on by the last body
};

// Acceleration is the sum of forces divided by the sum of inertias, both reduced to the last body; the torque of each
// link then follows from body to body. The gear's teeth pass on only the fraction `transmitted` of what they receive,
// which is equivalent to scaling all forces and inertias before the teeth by that fraction.
double solve_moving(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& mode,
                    const Segment& segment, double transmitted, Links& links, ChainMotion& out) noexcept {
  double inertia = 0.0, force = -segment.force_out, ratio = 1.0, fraction = 1.0;
  for (std::size_t b = segment.last + 1; b-- > segment.first;) {
    if (b < segment.last) ratio *= links.ratio[b];
    if (b == shaft_body && segment.last == car_body) fraction = transmitted;
    out.rate[b] = ratio;
    out.ground[b] = -mode.turn[b] * loads.ground[b];
    inertia += fraction * ratio * ratio * chain.inertia[b];
    force += fraction * ratio * (loads.push[b] + out.ground[b]);
  }
  force += fraction * ratio * segment.force_in;
  double carried = segment.force_in, violation = 0.0;
  for (std::size_t b = segment.first; b <= segment.last; ++b) {
    out.rate[b] *= force / inertia;
    if (b == segment.last) break;
    carried += loads.push[b] + out.ground[b] - chain.inertia[b] * out.rate[b];
    links.torque[b] = carried;
    violation += distance_outside(carried, -links.limit[b], links.limit[b]);
    carried *= links.ratio[b];
  }
  return violation;
}

// Solves twice if the teeth have losses: the solution without losses shows the direction of the power flow, on which
// the losses depend.
void solve_moving_with_teeth(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& mode,
                             const Segment& segment, Links& links, ChainMotion& out) noexcept {
  double violation = solve_moving(chain, loads, mode, segment, 1.0, links, out);
  double transmitted = 1.0;
  if (chain.efficiency != 1.0 && chain.link == GearLink::dogs && segment.last == car_body) {
    const bool forward = links.torque[1] * mode.turn[shaft_body] >= 0.0;
    transmitted = forward ? chain.efficiency : 1.0 / chain.efficiency;
    violation = solve_moving(chain, loads, mode, segment, transmitted, links, out);
  }
  out.violation += violation;
  if (segment.last == car_body) out.drive = transmitted * links.ratio[1] * links.torque[1];
}

// Solves for bodies at rest on the ground. Their link torques are not unique, only bounded. A first pass from left to
// right finds the ranges; a second pass from right to left picks the smallest torques that keep all bodies at rest.
void solve_resting(const FrictionChain& chain, const ChainLoads& loads, const Segment& segment, Links& links,
                   ChainMotion& out) noexcept {
  std::array<double, 2> low{}, high{};
  double from = segment.force_in, to = segment.force_in;
  for (std::size_t b = segment.first; b <= segment.last; ++b) {
    out.rate[b] = 0.0;
    from += loads.push[b] - loads.ground[b];
    to += loads.push[b] + loads.ground[b];
    if (b == segment.last) break;
    const double limit = links.limit[b];
    out.violation += distance_outside(std::clamp(0.0, from, to), -limit, limit);
    low[b] = std::clamp(from, -limit, limit);
    high[b] = std::clamp(to, -limit, limit);
    from = std::min(links.ratio[b] * low[b], links.ratio[b] * high[b]);
    to = std::max(links.ratio[b] * low[b], links.ratio[b] * high[b]);
    if (b == shaft_body && chain.link == GearLink::dogs) {  // friction in the teeth helps to hold the car
      from *= from > 0.0 ? chain.efficiency : 1.0 / chain.efficiency;
      to *= to > 0.0 ? 1.0 / chain.efficiency : chain.efficiency;
    }
  }
  out.violation += distance_outside(segment.force_out, from, to);
  double force_out = segment.force_out;
  for (std::size_t b = segment.last; b > segment.first; --b) {
    const double ratio = links.ratio[b - 1], needs = force_out - loads.push[b];
    const double one = (needs - loads.ground[b]) / ratio, other = (needs + loads.ground[b]) / ratio;
    const double smallest = std::clamp(0.0, std::min(one, other), std::max(one, other));
    links.torque[b - 1] = std::clamp(smallest, low[b - 1], high[b - 1]);
    out.ground[b] = needs - ratio * links.torque[b - 1];
    force_out = links.torque[b - 1];
  }
  if (segment.last == car_body) out.drive = links.ratio[1] * links.torque[1];
  out.ground[segment.first] = force_out - loads.push[segment.first] - segment.force_in;
}

// Bodies that stick together must turn in the same direction.
bool is_feasible(const FrictionChain& chain, const FrictionMode& mode) noexcept {
  if (mode.clutch == 0 && mode.turn[engine_body] != mode.turn[shaft_body]) return false;
  return !gear_holds(chain, mode) || mode.turn[shaft_body] == mode.turn[car_body] * sign(chain.per_road);
}

double slip_violation(int known, int chosen, double rate, double scale) noexcept {
  if (known != 0 || chosen == 0) return 0.0;
  return std::max(0.0, -chosen * rate - kSlack * scale);
}

Solution evaluate(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& known,
                  const FrictionMode& mode) noexcept {
  Solution s{mode, motion_in_mode(chain, loads, mode)};
  const PerBody& rate = s.motion.rate;
  const double engine = rate[engine_body], shaft = rate[shaft_body], gear = chain.per_road * rate[car_body];
  s.motion.violation += slip_violation(known.clutch, mode.clutch, engine - shaft, std::abs(engine) + std::abs(shaft));
  if (chain.link == GearLink::cone)
    s.motion.violation += slip_violation(known.cone, mode.cone, shaft - gear, std::abs(shaft) + std::abs(gear));
  for (std::size_t b = 0; b < 3; ++b) s.motion.violation += slip_violation(known.turn[b], mode.turn[b], rate[b], 0.0);
  return s;
}

FrictionMode merged(const FrictionMode& known, const FrictionMode& guess) noexcept {
  FrictionMode mode = known;
  if (known.clutch == 0) mode.clutch = guess.clutch;
  if (known.cone == 0) mode.cone = guess.cone;
  for (std::size_t b = 0; b < 3; ++b)
    if (known.turn[b] == 0) mode.turn[b] = guess.turn[b];
  return mode;
}

constexpr int kModes = 3 * 3 * 3 * 3 * 3;

// Returns mode `number`, 0 to kModes - 1. In mode 0 all elements stick; it is the most frequent result of a change.
FrictionMode mode_of(int number) noexcept {
  FrictionMode mode;
  for (int* element :
       {&mode.clutch, &mode.cone, &mode.turn[engine_body], &mode.turn[shaft_body], &mode.turn[car_body]}) {
    *element = number % 3 == 2 ? -1 : number % 3;
    number /= 3;
  }
  return mode;
}

bool repeats_known(const FrictionChain& chain, const FrictionMode& known, const FrictionMode& choice) noexcept {
  bool twice = (known.clutch != 0 && choice.clutch != 0) || (known.cone != 0 && choice.cone != 0);
  if (chain.link != GearLink::cone) twice = twice || choice.cone != 0;
  for (std::size_t b = 0; b < 3; ++b) twice = twice || (known.turn[b] != 0 && choice.turn[b] != 0);
  return twice;
}

}  // namespace

ChainMotion motion_in_mode(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& mode) noexcept {
  ChainMotion out;
  Links links = make_links(chain, loads, mode);
  for (std::size_t first = 0; first < 3;) {
    std::size_t last = first;
    while (last < 2 && links.is_holding[last]) ++last;
    const Segment segment{first, last, first > 0 ? links.ratio[first - 1] * links.torque[first - 1] : 0.0,
                          last < 2 ? links.torque[last] : 0.0};
    bool rests = false;
    for (std::size_t b = first; b <= last; ++b) rests = rests || mode.turn[b] == 0;
    if (rests)
      solve_resting(chain, loads, segment, links, out);
    else
      solve_moving_with_teeth(chain, loads, mode, segment, links, out);
    first = last + 1;
  }
  out.clutch = links.torque[0];
  out.gear = links.torque[1];
  return out;
}

Solution solve_modes(const FrictionChain& chain, const ChainLoads& loads, const FrictionMode& known,
                     const FrictionMode& guess) noexcept {
  Solution best;
  best.motion.violation = kNoLimit;
  const FrictionMode first = merged(known, guess);
  if (is_feasible(chain, first)) best = evaluate(chain, loads, known, first);
  for (int number = 0; best.motion.violation > 0.0 && number < kModes; ++number) {
    const FrictionMode choice = mode_of(number);
    if (repeats_known(chain, known, choice)) continue;
    const FrictionMode mode = merged(known, choice);
    if (!is_feasible(chain, mode)) continue;
    const Solution s = evaluate(chain, loads, known, mode);
    if (s.motion.violation < best.motion.violation) best = s;
  }
  return best;
}

PerBody collide(const FrictionChain& chain, const PerBody& speed, const FrictionMode& mode) noexcept {
  FrictionChain bare = chain;  // an impact has no losses in the teeth
  bare.efficiency = 1.0;
  ChainLoads momentum;
  for (std::size_t b = 0; b < 3; ++b) momentum.push[b] = chain.inertia[b] * speed[b];
  return motion_in_mode(bare, momentum, mode).rate;
}

double kinetic_energy(const FrictionChain& chain, const PerBody& speed) noexcept {
  double energy = 0.0;
  for (std::size_t b = 0; b < 3; ++b) energy += 0.5 * chain.inertia[b] * speed[b] * speed[b];
  return energy;
}

}  // namespace gearshift::vehicle
