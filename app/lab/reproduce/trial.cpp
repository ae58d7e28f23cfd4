#include "app/lab/reproduce/trial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/lab/reproduce/study_files.h"
#include "haptics/analysis/sampled_loop.h"
#include "haptics/gate/plain_aisle.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kSettleTime = 0.050;  // [s] time at full force before the start, so that filters and estimates settle
constexpr double kApproach = 0.015;    // [s] time of steady motion before a contact

// The hand of a trial. Before begin() is called, the hand holds the lever at the start position against motors and
// spring.
class TrialHand final : public haptics::HandDriver {
 public:
  explicit TrialHand(const Trial& trial) : trial_(trial) {}

  haptics::HandTarget next(double time, dvec2 lever) noexcept override {
    if (begun_) return trial_.hand(time - begin_, lever);
    const dvec2 spring{trial_.lever.axis_x.stiffness, trial_.lever.axis_y.stiffness};
    haptics::HandTarget target;
    target.position = trial_.start;
    target.push = spring * trial_.start - due();
    return target;
  }

  void resist(dvec2 commanded) { commanded_.push_back(commanded); }
  void begin(double time) noexcept { begun_ = true, begin_ = time; }

 private:
  // Motor force in the coming period. [N]
  dvec2 due() const noexcept {
    const std::size_t age = 1 + static_cast<std::size_t>(trial_.lever.delay);
    return commanded_.size() < age ? dvec2(0.0) : commanded_[commanded_.size() - age];
  }

  const Trial& trial_;
  std::vector<dvec2> commanded_;  // [N]
  bool begun_ = false;
  double begin_ = 0.0;  // [s] on the lever's clock
};

haptics::SimulatedRunConfig run_config(const Trial& trial) {
  haptics::SimulatedRunConfig config;
  config.haptics = trial.haptics;
  config.lever = trial.lever;
  config.gate = trial.gate;
  config.start = trial.start;
  return config;
}

std::size_t cycles(double time, double period) {
  return static_cast<std::size_t>(std::lround(time / period));
}

// Resets the lever to the start position every cycle until the guard has ramped the force up from zero.
void hold_at_start(haptics::SimulatedRun& run, TrialHand& hand, const Trial& trial) {
  const std::size_t count = cycles(trial.haptics.guard.ramp_time + kSettleTime, run.period());
  for (std::size_t i = 0; i <= count; ++i) {
    run.lever().place(trial.start);
    hand.resist(run.step().commanded);
  }
  run.lever().place(trial.start, trial.velocity);
  hand.begin(static_cast<double>(count) * run.period());
}

TrialSample sample_of(haptics::SimulatedRun& run, const haptics::HapticSnapshot& now, double time) {
  TrialSample sample;
  sample.time = time;
  sample.position = run.lever().true_position();
  sample.velocity = run.lever().true_velocity();
  sample.proxy = now.proxy;
  sample.motor = -now.f_a;
  sample.hand = now.f_h;
  sample.wall = now.wall_force;
  sample.commanded = now.commanded;
  sample.flags = now.flags;
  return sample;
}

}  // namespace

TrialRun run_trial(const Trial& trial) {
  TrialHand hand(trial);
  haptics::SimulatedRun run(run_config(trial), hand, trial.load);
  hold_at_start(run, hand, trial);

  const double period = run.period();
  TrialRun result{period, trial.lever.delay, run.loop().admitted(), 0.0, {}};
  const std::size_t count = cycles(trial.duration, period);
  result.samples.reserve(count + 1);
  result.samples.push_back(sample_of(run, run.loop().snapshot(), 0.0));
  for (std::size_t i = 1; i <= count; ++i) {
    const double time = static_cast<double>(i) * period;
    const haptics::HapticSnapshot& now = run.step();
    result.samples.push_back(sample_of(run, now, time));
    result.stiffness = now.wall_stiffness;
  }
  return result;
}

HandFunction carried_to(double wall, double speed, const haptics::AxisModel& axis, haptics::HandTarget after) {
  return [=, arrived = false](double, dvec2 lever) mutable {
    arrived = arrived || lever.x >= wall;
    if (arrived) return after;
    haptics::HandTarget target;
    target.position = lever;
    target.velocity = {speed, 0.0};
    target.push = {axis.damping * speed + axis.stiffness * lever.x, 0.0};
    return target;
  };
}

dvec2 before(double wall, double speed, double period, double phase) {
  return {wall - speed * (kApproach + phase * period), 0.0};
}

haptics::Gate wall_at_zero() {
  haptics::Gate gate = haptics::plain_aisle(0.070, 0.060);
  gate.select_max = 0.0;
  return gate;
}

std::vector<TrialContact> contacts(const TrialRun& run, const haptics::Gate& gate) {
  std::vector<TrialContact> found;
  bool inside = false;
  int acting = 0;  // [periods] for which the wall's forces still act
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    const TrialSample &last = run.samples[i - 1], &now = run.samples[i];
    const bool is_inside = now.position.x > gate.select_max || now.position.x < gate.select_min;
    if (is_inside && !inside) found.push_back({now.time, 0.0, std::abs(last.velocity.x), 0.0, false});
    acting = is_inside || inside ? run.delay + 1 : acting - 1;
    if (acting > 0) found.back().energy += now.motor.x * (now.position.x - last.position.x);
    if (is_inside || inside) found.back().end = now.time;
    if (inside && !is_inside) found.back().left = true;
    inside = is_inside;
  }
  return found;
}

double predicted_radius(const Trial& trial, const haptics::AdmittedTuning& admitted) {
  haptics::DeviceSpec device;
  device.delay = trial.lever.delay;
  const haptics::ContactLaw law = haptics::contact_law(trial.haptics, admitted, device);
  return haptics::spectral_radius(trial.lever.axis_x, trial.lever.hand, law, haptics::period_s(trial.haptics));
}

double deepest(const TrialRun& run) {
  double max_x = run.samples.front().position.x;
  for (const TrialSample& sample : run.samples) max_x = std::max(max_x, sample.position.x);
  return max_x;
}

double peak_to_peak(const TrialRun& run, double seconds) {
  const std::size_t last = std::min(cycles(seconds, run.period) + 1, run.samples.size());
  double low = run.samples.back().position.x, high = low;
  for (std::size_t i = run.samples.size() - last; i < run.samples.size(); ++i) {
    low = std::min(low, run.samples[i].position.x);
    high = std::max(high, run.samples[i].position.x);
  }
  return high - low;
}

void TrialTable::add(std::string name, std::vector<double> cells) {
  names_.push_back(std::move(name));
  columns_.push_back(std::move(cells));
}

void TrialTable::write(const Study& study, std::string_view name) const {
  CsvFile csv(study, name, fmt::format("{}", fmt::join(names_, ",")));
  std::size_t rows = 0;
  for (const std::vector<double>& column : columns_) rows = std::max(rows, column.size());
  for (std::size_t i = 0; i < rows; ++i) {
    std::string line;
    for (const std::vector<double>& column : columns_) {
      if (&column != &columns_.front()) line += ',';
      if (i < column.size()) line += fmt::format("{:.9g}", column[i]);
    }
    csv.line(line);
  }
  csv.finish();
}

}  // namespace gearshift::lab
