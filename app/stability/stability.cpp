#include "app/stability/stability.h"

#include <algorithm>

#include "haptics/analysis/passivity.h"

namespace gearshift {
namespace {

constexpr int kMapSteps = 120;
constexpr double kLeastEnd = 0.01;  // [1] of m / T: a map has a width even where no damping is stable

ContactLaw with_damping(ContactLaw wall, double damping) {
  wall.damping = damping;
  return wall;
}

double limit_of(const StabilityQuestion& question, const JudgedHand& judged, double damping) {
  return stiffness_limit(question.handle, judged.hand, with_damping(question.wall, damping), question.period());
}

bool has_passive_limit(const StabilityQuestion& question) {
  return question.wall.hold != ContactHold::observer;
}

double passive_limit(const StabilityQuestion& question, double damping) {
  return passive_stiffness_limit(question.handle.damping, with_damping(question.wall, damping), question.period());
}

// Damping from which on no stiffness is stable; where an observer bears any, several times what there is use for.
double damping_end(const StabilityQuestion& question, const JudgedHand& judged) {
  const double inertia = (question.handle.mass + judged.hand.mass) / question.period();
  double good = 0.0, bad = 4.0 * (inertia + question.handle.damping + judged.hand.damping);
  if (limit_of(question, judged, bad) > 0.0) return bad;
  while (bad - good > 0.002 * bad && bad > kLeastEnd * inertia) {
    const double middle = 0.5 * (good + bad);
    (limit_of(question, judged, middle) > 0.0 ? good : bad) = middle;
  }
  return bad;
}

// Beyond where the first hand gives up, the device's own damping (there the passive limit ends) and what is wanted.
double map_end(const StabilityQuestion& question) {
  double end = damping_end(question, question.hands.front());
  for (const JudgedHand& judged : question.hands) end = std::min(end, damping_end(question, judged));
  return std::max({1.08 * end, 1.3 * question.handle.damping, 1.15 * question.wall.damping});
}

}  // namespace

StabilityAnswer answer(const StabilityQuestion& question) {
  StabilityAnswer out;
  for (const JudgedHand& judged : question.hands) {
    out.hands.push_back({limit_of(question, judged, question.wall.damping),
                         spectral_radius(question.handle, judged.hand, question.wall, question.period())});
    if (out.hands.back().limit < out.hands[out.deciding].limit) out.deciding = out.hands.size() - 1;
    out.radius = std::max(out.radius, out.hands.back().radius);
  }
  out.limit = out.hands[out.deciding].limit;
  out.stable = out.radius < 1.0;
  out.may_use = out.stable && question.wall.stiffness <= out.limit;
  if (has_passive_limit(question)) {
    const double demand = damping_demand(contact(question.wall, question.period()), question.period());
    out.passive = demand < question.handle.damping;
    out.passive_limit = passive_limit(question, question.wall.damping);
  }
  return out;
}

StabilityMap stability_map(const StabilityQuestion& question, const std::function<void(double)>& progress) {
  StabilityMap map;
  map.limits.resize(question.hands.size());
  const double end = map_end(question);
  for (int i = 0; i <= kMapSteps; ++i) {
    progress(static_cast<double>(i) / kMapSteps);
    const double damping = end * i / kMapSteps;
    map.damping.push_back(damping);
    for (std::size_t h = 0; h < question.hands.size(); ++h) {
      map.limits[h].push_back(limit_of(question, question.hands[h], damping));
    }
    if (has_passive_limit(question)) map.passive.push_back(passive_limit(question, damping));
  }
  return map;
}

}  // namespace gearshift
