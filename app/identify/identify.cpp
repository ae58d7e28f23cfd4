#include "app/identify/identify.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <fmt/core.h>

namespace gearshift {
namespace {

constexpr int kReadingsPerWeight = 20;

SweepConfig literal_config() {
  SweepConfig config;
  config.highest = config.lowest = 1.0;
  config.points = 1;
  config.literal = true;
  return config;
}

FrequencyResponse whole(FrequencyResponse response) {
  if (response.problem.empty()) return response;
  throw std::runtime_error(
      fmt::format("axis {}: the sweep ended early: {}", lever_axis_name(response.axis), response.problem));
}

}  // namespace

SweepConfig preset_sweep(const Preset& preset) {
  SweepConfig config;
  config.highest = std::min(config.highest, 0.25 * preset.haptics.rate);
  return config;
}

FrequencyResponse sweep_lever(const Preset& preset, LeverAxis axis, const SweepConfig& config,
                              const SweepProgress& progress) {
  SimulatedLeverConfig lever = preset.lever;
  lever.hand = kBareHand;
  RestingHand nobody;
  SimulatedLever device(lever, period_ns(preset.haptics), nobody);
  std::int64_t now = 0;
  return sweep_frequencies(config, device, axis, period_s(preset.haptics), now, progress);
}

AxisIdentification identify_axis(const Preset& preset, LeverAxis axis, const SweepProgress& progress) {
  AxisIdentification found;
  found.nominal = axis == LeverAxis::x ? preset.lever.axis_x : preset.lever.axis_y;
  try {
    found.response = whole(sweep_lever(preset, axis, preset_sweep(preset), progress));
    found.fit = fit_axis(found.response);
    found.literal = whole(sweep_lever(preset, axis, literal_config())).points.at(0);
  } catch (const std::invalid_argument& refused) {
    throw std::runtime_error(fmt::format("axis {}: {}", lever_axis_name(axis), refused.what()));
  }
  return found;
}

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
