#include "app/lab/identify/identify.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include <fmt/core.h>

namespace gearshift::lab {
namespace {

constexpr int kReadingsPerWeight = 20;

haptics::SweepConfig literal_config() {
  haptics::SweepConfig config;
  config.highest = config.lowest = 1.0;
  config.points = 1;
  config.literal = true;
  return config;
}

haptics::FrequencyResponse require_complete(haptics::FrequencyResponse response) {
  if (response.problem.empty()) return response;
  throw std::runtime_error(
      fmt::format("the sweep of axis {} ended early: {}", to_string(response.axis), response.problem));
}

}  // namespace

haptics::SweepConfig preset_sweep(const haptics::Preset& preset) {
  haptics::SweepConfig config;
  config.highest = std::min(config.highest, 0.25 * preset.haptics.rate);
  return config;
}

haptics::FrequencyResponse sweep_lever(const haptics::Preset& preset, haptics::LeverAxis axis,
                                       const haptics::SweepConfig& config, const haptics::SweepProgress& progress) {
  haptics::SimulatedLeverConfig lever = preset.lever;
  lever.hand = haptics::kBareHand;
  haptics::IdleHand idle_hand;
  haptics::SimulatedLever device(lever, haptics::period_ns(preset.haptics), idle_hand);
  std::int64_t now = 0;
  return haptics::sweep_frequencies(config, device, axis, haptics::period_s(preset.haptics), now, progress);
}

AxisIdentification identify_axis(const haptics::Preset& preset, haptics::LeverAxis axis,
                                 const haptics::SweepProgress& progress) {
  AxisIdentification found;
  found.nominal = axis == haptics::LeverAxis::x ? preset.lever.axis_x : preset.lever.axis_y;
  found.nominal_friction = preset.lever.coulomb_friction;
  try {
    found.response = require_complete(sweep_lever(preset, axis, preset_sweep(preset), progress));
    found.fit = haptics::fit_axis(found.response);
    found.literal = require_complete(sweep_lever(preset, axis, literal_config())).points.at(0);
  } catch (const std::invalid_argument& refused) {
    throw std::runtime_error(fmt::format("axis {} cannot be measured, because {}", to_string(axis), refused.what()));
  }
  return found;
}

Identification identify_lever(const haptics::Preset& preset, const std::vector<haptics::LeverAxis>& axes,
                              const IdentifyProgress& progress) {
  Identification found;
  haptics::IdleHand idle_hand;
  found.spec = haptics::SimulatedLever(preset.lever, haptics::period_ns(preset.haptics), idle_hand).spec();
  found.rate = preset.haptics.rate;
  found.sensor = preset.lever.force_sensor;
  for (const haptics::LeverAxis axis : axes) {
    const double before = static_cast<double>(found.axes.size()), all = static_cast<double>(axes.size());
    found.axes.push_back(identify_axis(preset, axis, [&](double fraction) {
      if (progress) progress("sweep", (before + fraction) / all);
    }));
  }
  found.calibration =
      haptics::calibrate_sensor(haptics::weigh(found.sensor, found.sensor, kReadingsPerWeight, preset.lever.seed));
  return found;
}

}  // namespace gearshift::lab
