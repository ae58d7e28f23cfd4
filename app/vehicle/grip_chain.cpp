#include "app/vehicle/grip_chain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gearshift {
namespace {

constexpr double kSlack = 1e-12;  // [1] of the forces: rounding is no reason to slip
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// By how much `force` is outside of the range.
double outside(double force, double low, double high) noexcept {
  const double by = std::max(low - force, force - high);
  return by > 0.0 ? std::max(0.0, by - kSlack * (std::abs(force) + std::abs(force < low ? low : high))) : 0.0;
}

// Links as an array: link i lies between body i and body i + 1, whose speeds have the ratio `ratio` where it holds.
struct Links {
  std::array<bool, 2> holds;
  std::array<double, 2> ratio, most;
  std::array<double, 2> carries{};  // at its left body
};

Links links_of(const GripChain& chain, const ChainLoads& loads, const GripMode& mode) noexcept {
  const bool dogs = chain.link == GearLink::dogs, cone = chain.link == GearLink::cone;
  Links links{{mode.clutch == 0, gear_holds(chain, mode)}, {1.0, chain.per_road}, {loads.clutch, loads.cone}, {}};
  if (dogs) links.most[1] = kNoLimit;
  if (!links.holds[0]) links.carries[0] = mode.clutch * loads.clutch;
  if (cone && mode.cone != 0) links.carries[1] = mode.cone * loads.cone;
  return links;
}

struct Run {
  std::size_t first, last;  // bodies that move as one
  double enters, leaves;    // [N m] or [N] into the first and out of the last
};

// Sum of forces over sum of inertias, both seen at the last body; then from body to body what each link carries. Of what
// the gear's teeth take in, `passes` comes out: as if all before them were so much weaker and lighter.
double drive(const GripChain& chain, const ChainLoads& loads, const GripMode& mode, const Run& run, double passes,
             Links& links, ChainMotion& out) noexcept {
  double inertia = 0.0, force = -run.leaves, seen = 1.0, share = 1.0;
  for (std::size_t b = run.last + 1; b-- > run.first;) {
    if (b < run.last) seen *= links.ratio[b];
    if (b == shaft_body && run.last == car_body) share = passes;
    out.rate[b] = seen;
    out.ground[b] = -mode.turn[b] * loads.ground[b];
    inertia += share * seen * seen * chain.inertia[b];
    force += share * seen * (loads.push[b] + out.ground[b]);
  }
  force += share * seen * run.enters;
  double carried = run.enters, lacks = 0.0;
  for (std::size_t b = run.first; b <= run.last; ++b) {
    out.rate[b] *= force / inertia;
    if (b == run.last) break;
    carried += loads.push[b] + out.ground[b] - chain.inertia[b] * out.rate[b];
    links.carries[b] = carried;
    lacks += outside(carried, -links.most[b], links.most[b]);
    carried *= links.ratio[b];
  }
  return lacks;
}

// The teeth lose in the direction of the power. Which that is does not depend on how much they lose.
void drive_through_teeth(const GripChain& chain, const ChainLoads& loads, const GripMode& mode, const Run& run,
                         Links& links, ChainMotion& out) noexcept {
  double lacks = drive(chain, loads, mode, run, 1.0, links, out);
  double passes = 1.0;
  if (chain.efficiency != 1.0 && chain.link == GearLink::dogs && run.last == car_body) {
    const bool forward = links.carries[1] * mode.turn[shaft_body] >= 0.0;
    passes = forward ? chain.efficiency : 1.0 / chain.efficiency;
    lacks = drive(chain, loads, mode, run, passes, links, out);
  }
  out.lacks += lacks;
  if (run.last == car_body) out.drive = passes * links.ratio[1] * links.carries[1];
}

// At rest on the ground. What each link carries is not determined then, only its range: ranges go from left to right,
// and from right to left the least is taken that serves.
void hold(const GripChain& chain, const ChainLoads& loads, const Run& run, Links& links, ChainMotion& out) noexcept {
  std::array<double, 2> low{}, high{};
  double from = run.enters, to = run.enters;
  for (std::size_t b = run.first; b <= run.last; ++b) {
    out.rate[b] = 0.0;
    from += loads.push[b] - loads.ground[b];
    to += b == engine_body ? kNoLimit : loads.push[b] + loads.ground[b];
    if (b == run.last) break;
    const double most = links.most[b];
    out.lacks += outside(std::clamp(0.0, from, to), -most, most);
    low[b] = std::clamp(from, -most, most);
    high[b] = std::clamp(to, -most, most);
    from = std::min(links.ratio[b] * low[b], links.ratio[b] * high[b]);
    to = std::max(links.ratio[b] * low[b], links.ratio[b] * high[b]);
    if (b == shaft_body && chain.link == GearLink::dogs) {  // the teeth help to hold
      from *= from > 0.0 ? chain.efficiency : 1.0 / chain.efficiency;
      to *= to > 0.0 ? 1.0 / chain.efficiency : chain.efficiency;
    }
  }
  out.lacks += outside(run.leaves, from, to);
  double leaves = run.leaves;
  for (std::size_t b = run.last; b > run.first; --b) {
    const double ratio = links.ratio[b - 1], needs = leaves - loads.push[b];
    const double one = (needs - loads.ground[b]) / ratio, other = (needs + loads.ground[b]) / ratio;
    const double least = std::clamp(0.0, std::min(one, other), std::max(one, other));
    links.carries[b - 1] = std::clamp(least, low[b - 1], high[b - 1]);
    out.ground[b] = needs - ratio * links.carries[b - 1];
    leaves = links.carries[b - 1];
  }
  if (run.last == car_body) out.drive = links.ratio[1] * links.carries[1];
  out.ground[run.first] = leaves - loads.push[run.first] - run.enters;
}

// Bodies that hold each other must turn together, and the engine does not turn backwards.
bool fits(const GripChain& chain, const GripMode& mode) noexcept {
  if (mode.turn[engine_body] < 0) return false;
  if (mode.clutch == 0 && mode.turn[engine_body] != mode.turn[shaft_body]) return false;
  return !gear_holds(chain, mode) || mode.turn[shaft_body] == mode.turn[car_body] * sign(chain.per_road);
}

double wrong_way(int known, int chosen, double rate, double scale) noexcept {
  if (known != 0 || chosen == 0) return 0.0;
  return std::max(0.0, -chosen * rate - kSlack * scale);
}

Settled tried(const GripChain& chain, const ChainLoads& loads, const GripMode& known, const GripMode& mode) noexcept {
  Settled s{mode, move(chain, loads, mode)};
  const PerBody& rate = s.motion.rate;
  const double engine = rate[engine_body], shaft = rate[shaft_body], gear = chain.per_road * rate[car_body];
  s.motion.lacks += wrong_way(known.clutch, mode.clutch, engine - shaft, std::abs(engine) + std::abs(shaft));
  if (chain.link == GearLink::cone)
    s.motion.lacks += wrong_way(known.cone, mode.cone, shaft - gear, std::abs(shaft) + std::abs(gear));
  for (std::size_t b = 0; b < 3; ++b) s.motion.lacks += wrong_way(known.turn[b], mode.turn[b], rate[b], 0.0);
  return s;
}

GripMode merged(const GripMode& known, const GripMode& guess) noexcept {
  GripMode mode = known;
  if (known.clutch == 0) mode.clutch = guess.clutch;
  if (known.cone == 0) mode.cone = guess.cone;
  for (std::size_t b = 0; b < 3; ++b)
    if (known.turn[b] == 0) mode.turn[b] = guess.turn[b];
  return mode;
}

constexpr int kModes = 3 * 3 * 3 * 3 * 3;

// All that holds first, for that is the commonest where something changes.
GripMode mode_of(int number) noexcept {
  GripMode mode;
  for (int* grip : {&mode.clutch, &mode.cone, &mode.turn[engine_body], &mode.turn[shaft_body], &mode.turn[car_body]}) {
    *grip = number % 3 == 2 ? -1 : number % 3;
    number /= 3;
  }
  return mode;
}

bool decides_twice(const GripChain& chain, const GripMode& known, const GripMode& choice) noexcept {
  bool twice = (known.clutch != 0 && choice.clutch != 0) || (known.cone != 0 && choice.cone != 0);
  if (chain.link != GearLink::cone) twice = twice || choice.cone != 0;
  for (std::size_t b = 0; b < 3; ++b) twice = twice || (known.turn[b] != 0 && choice.turn[b] != 0);
  return twice;
}

}  // namespace

ChainMotion move(const GripChain& chain, const ChainLoads& loads, const GripMode& mode) noexcept {
  ChainMotion out;
  Links links = links_of(chain, loads, mode);
  for (std::size_t first = 0; first < 3;) {
    std::size_t last = first;
    while (last < 2 && links.holds[last]) ++last;
    const Run run{first, last, first > 0 ? links.ratio[first - 1] * links.carries[first - 1] : 0.0,
                  last < 2 ? links.carries[last] : 0.0};
    bool rests = false;
    for (std::size_t b = first; b <= last; ++b) rests = rests || mode.turn[b] == 0;
    if (rests)
      hold(chain, loads, run, links, out);
    else
      drive_through_teeth(chain, loads, mode, run, links, out);
    first = last + 1;
  }
  out.clutch = links.carries[0];
  out.gear = links.carries[1];
  return out;
}

Settled settle(const GripChain& chain, const ChainLoads& loads, const GripMode& known, const GripMode& guess) noexcept {
  Settled best;
  best.motion.lacks = kNoLimit;
  const GripMode first = merged(known, guess);
  if (fits(chain, first)) best = tried(chain, loads, known, first);
  for (int number = 0; best.motion.lacks > 0.0 && number < kModes; ++number) {
    const GripMode choice = mode_of(number);
    if (decides_twice(chain, known, choice)) continue;
    const GripMode mode = merged(known, choice);
    if (!fits(chain, mode)) continue;
    const Settled s = tried(chain, loads, known, mode);
    if (s.motion.lacks < best.motion.lacks) best = s;
  }
  return best;
}

PerBody collide(const GripChain& chain, const PerBody& speed, const GripMode& mode) noexcept {
  GripChain bare = chain;  // an impact shares momentum, teeth or not
  bare.efficiency = 1.0;
  ChainLoads momentum;
  for (std::size_t b = 0; b < 3; ++b) momentum.push[b] = chain.inertia[b] * speed[b];
  return move(bare, momentum, mode).rate;
}

double kinetic_energy(const GripChain& chain, const PerBody& speed) noexcept {
  double energy = 0.0;
  for (std::size_t b = 0; b < 3; ++b) energy += 0.5 * chain.inertia[b] * speed[b] * speed[b];
  return energy;
}

}  // namespace gearshift
