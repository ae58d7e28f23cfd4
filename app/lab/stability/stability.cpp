#include "app/lab/stability/stability.h"

#include <algorithm>

#include "haptics/analysis/passivity.h"

namespace gearshift::lab {
namespace {

constexpr int kMapSteps = 120;
constexpr double kMinMapEnd = 0.01;  // [1] lower end of the search in damping_end(), as a fraction of `inertia`

haptics::ContactLaw with_damping(haptics::ContactLaw wall, double damping) {
  wall.damping = damping;
  return wall;
}

double limit_of(const StabilityQuestion& question, const JudgedHand& judged, double damping) {
  return haptics::stiffness_limit(question.handle, judged.hand, with_damping(question.wall, damping),
                                  question.period());
}

bool has_passive_limit(const StabilityQuestion& question) {
  return question.wall.hold != haptics::ContactHold::observer;
}

double passive_limit(const StabilityQuestion& question, double damping) {
  return haptics::passive_stiffness_limit(question.handle.damping, with_damping(question.wall, damping),
                                          question.period());
}

// Returns the damping above which no stiffness is stable. If every damping is stable (observer hold), returns a value
// far above practical ones.
double damping_end(const StabilityQuestion& question, const JudgedHand& judged) {
  const double inertia = (question.handle.mass + judged.hand.mass) / question.period();
  double good = 0.0, bad = 4.0 * (inertia + question.handle.damping + judged.hand.damping);
  if (limit_of(question, judged, bad) > 0.0) return bad;
  while (bad - good > 0.002 * bad && bad > kMinMapEnd * inertia) {
    const double middle = 0.5 * (good + bad);
    (limit_of(question, judged, middle) > 0.0 ? good : bad) = middle;
  }
  return bad;
}

// Returns the damping at the right end of the map. The map contains three values: the lowest damping at which some hand
// has no stable stiffness; the device's own damping, where the passivity limit ends; the wanted damping.
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
                         haptics::spectral_radius(question.handle, judged.hand, question.wall, question.period())});
    if (out.hands.back().limit < out.hands[out.deciding].limit) out.deciding = out.hands.size() - 1;
    out.radius = std::max(out.radius, out.hands.back().radius);
  }
  out.limit = out.hands[out.deciding].limit;
  out.stable = out.radius < 1.0;
  out.may_use = out.stable && question.wall.stiffness <= out.limit;
  if (has_passive_limit(question)) {
    const double demand =
        haptics::damping_demand(haptics::contact_environment(question.wall, question.period()), question.period());
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

}  // namespace gearshift::lab
