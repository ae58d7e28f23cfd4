#include "app/reproduce/identified_axes.h"

#include <algorithm>
#include <cstdint>

namespace gearshift {

FrequencyResponse sweep_axis(const Study& study, LeverAxis axis, bool literal) {
  const double period = period_s(study.preset.haptics);
  SimulatedLeverConfig config = study.preset.lever;
  config.hand = kBareHand;
  RestingHand nobody;
  SimulatedLever lever(config, period_ns(study.preset.haptics), nobody);
  SweepConfig sweep;
  sweep.highest = std::min(kPaperHighest, 0.4 / period);
  sweep.literal = literal;
  std::int64_t now_ns = 0;
  return sweep_frequencies(sweep, lever, axis, period, now_ns, [&](double) {
    if (study.doing) study.doing("frequency sweep");
  });
}

std::array<IdentifiedAxis, 2> identify_axes(const Study& study) {
  const auto identify = [&](LeverAxis axis) {
    IdentifiedAxis one{sweep_axis(study, axis, false), {}};
    one.fit = fit_axis(one.response);
    return one;
  };
  return {identify(LeverAxis::x), identify(LeverAxis::y)};
}

}  // namespace gearshift
