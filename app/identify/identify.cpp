#include "app/identify/identify.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <fmt/core.h>

namespace gearshift {
namespace {

constexpr int kReadingsPerWeight = 20;

// On a lever of its own, so that no axis depends on what was done to the other.
FrequencyResponse sweep(const Preset& preset, LeverAxis axis, const SweepConfig& config,
                        const SweepProgress& progress = {}) {
  SimulatedLeverConfig lever = preset.lever;
  lever.hand = kBareHand;
  RestingHand nobody;
  SimulatedLever device(lever, period_ns(preset.haptics), nobody);
  std::int64_t now = 0;
  return sweep_frequencies(config, device, axis, period_s(preset.haptics), now, progress);
}

SweepConfig sweep_config(double rate) {
  SweepConfig config;
  config.highest = std::min(config.highest, 0.25 * rate);
  return config;
}

SweepConfig literal_config() {
  SweepConfig config;
  config.highest = config.lowest = 1.0;
  config.points = 1;
  config.literal = true;
  return config;
}

AxisIdentification identify_axis(const Preset& preset, LeverAxis axis, const SweepProgress& progress) {
  AxisIdentification found;
  found.response = sweep(preset, axis, sweep_config(preset.haptics.rate), progress);
  if (!found.response.problem.empty()) {
    throw std::runtime_error(
        fmt::format("axis {}: the sweep ended early: {}", lever_axis_name(axis), found.response.problem));
  }
  try {
    found.fit = fit_axis(found.response);
  } catch (const std::invalid_argument& refused) {
    throw std::runtime_error(fmt::format("axis {}: {}", lever_axis_name(axis), refused.what()));
  }
  found.nominal = axis == LeverAxis::x ? preset.lever.axis_x : preset.lever.axis_y;
  found.literal = sweep(preset, axis, literal_config()).points.at(0);
  return found;
}

}  // namespace

const char* lever_axis_name(LeverAxis axis) noexcept {
  return axis == LeverAxis::x ? "x" : "y";
}

Identification identify_lever(const Preset& preset, const std::vector<LeverAxis>& axes,
                              const IdentifyProgress& progress) {
  Identification found;
  RestingHand nobody;
  found.spec = SimulatedLever(preset.lever, period_ns(preset.haptics), nobody).spec();
  found.rate = preset.haptics.rate;
  found.sensor = preset.lever.force_sensor;
  for (const LeverAxis axis : axes) {
    const double before = static_cast<double>(found.axes.size()), all = static_cast<double>(axes.size());
    found.axes.push_back(identify_axis(preset, axis, [&](double share) {
      if (progress) progress("sweep", (before + share) / all);
    }));
  }
  found.calibration = calibrate_sensor(weigh(found.sensor, found.sensor, kReadingsPerWeight, preset.lever.seed));
  return found;
}

}  // namespace gearshift
