#include "app/reproduce/element_trial.h"

#include "haptics/analysis/passivity.h"
#include "haptics/gate/plain_aisle.h"

namespace gearshift {
namespace {

double passive_limit(double damping, const AxisModel& unit, double period) {
  return damping / damping_demand(impedance(unit.stiffness, unit.damping, unit.mass, period), period);
}

}  // namespace

ElementLimits element_limits(const AxisModel& handle, double period) {
  const double b = handle.damping;
  return {passive_limit(b, {0.0, 0.0, 1.0}, period), passive_limit(b, {0.0, 1.0, 0.0}, period),
          passive_limit(b, {1.0, 0.0, 0.0}, period)};
}

Trial open_trial(const Study& study, double rate) {
  Trial trial;
  trial.haptics = study.preset.haptics;
  trial.haptics.rate = rate;
  trial.haptics.tuning.aisle_damping = 0.0;
  trial.haptics.tuning.limit_damping = 0.0;
  trial.lever = study.preset.lever;
  trial.gate = plain_aisle(0.5, 0.5);
  return trial;
}

TrialRun led_run(Trial trial, const std::vector<HandStroke>& strokes, LeverWorld* world) {
  ScriptedHandConfig config;
  config.start = trial.start;
  ScriptedHand hand(config, strokes, period_s(trial.haptics));
  trial.hand = [&hand](double time, glm::dvec2 lever) { return hand.next(time, lever); };
  trial.lever.hand = kGripHand;
  trial.world = world;
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
    const glm::dvec3 seen{x0, (x0 - last) / period, (x0 - 2.0 * last + first) / (period * period)};
    const glm::dvec3 felt{0.5 * (x0 + x1), (x1 - x0) / period, (end.velocity[axis] - begin.velocity[axis]) / period};
    holds.push_back({begin.time, -end.motor[axis], seen, felt});
  }
  return holds;
}

}  // namespace gearshift
