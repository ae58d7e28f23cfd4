#include "app/lab/reproduce/element_trial.h"

#include "haptics/analysis/passivity.h"
#include "haptics/gate/plain_aisle.h"

namespace gearshift::lab {
namespace {

double passive_limit(double damping, const haptics::AxisModel& unit, double period) {
  return damping / haptics::damping_demand(haptics::impedance(unit.stiffness, unit.damping, unit.mass, period), period);
}

}  // namespace

ElementLimits element_limits(const haptics::AxisModel& handle, double period) {
  const double b = handle.damping;
  return {passive_limit(b, {0.0, 0.0, 1.0}, period), passive_limit(b, {0.0, 1.0, 0.0}, period),
          passive_limit(b, {1.0, 0.0, 0.0}, period)};
}

Trial free_trial(const Study& study, double rate) {
  Trial trial;
  trial.haptics = study.preset.haptics;
  trial.haptics.rate = rate;
  trial.haptics.tuning.aisle_damping = 0.0;
  trial.haptics.tuning.limit_damping = 0.0;
  trial.lever = study.preset.lever;
  trial.gate = haptics::plain_aisle(0.5, 0.5);
  return trial;
}

TrialRun run_with_hand(Trial trial, const std::vector<haptics::HandStroke>& strokes, haptics::LeverLoad* load) {
  haptics::ScriptedHandConfig config;
  config.start = trial.start;
  haptics::ScriptedHand hand(config, strokes, haptics::period_s(trial.haptics));
  trial.hand = [&hand](double time, glm::dvec2 lever) { return hand.next(time, lever); };
  trial.lever.hand = haptics::kGripHand;
  trial.load = load;
  trial.duration = hand.duration();
  return run_trial(trial);
}

std::vector<ElementHold> holds_of(const TrialRun& run, int axis) {
  std::vector<ElementHold> holds;
  const double period = run.period;
  for (std::size_t i = 2; i + 1 < run.samples.size(); ++i) {
    const TrialSample &begin = run.samples[i], &end = run.samples[i + 1];
    const double x0 = begin.position[axis], x1 = end.position[axis];
    const double last = run.samples[i - 1].position[axis], first = run.samples[i - 2].position[axis];
    const glm::dvec3 sampled{x0, (x0 - last) / period, (x0 - 2.0 * last + first) / (period * period)};
    const glm::dvec3 actual{0.5 * (x0 + x1), (x1 - x0) / period, (end.velocity[axis] - begin.velocity[axis]) / period};
    holds.push_back({begin.time, -end.motor[axis], sampled, actual});
  }
  return holds;
}

}  // namespace gearshift::lab
