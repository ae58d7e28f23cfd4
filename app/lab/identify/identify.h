// Measures a preset's simulated lever as in sections 2.3 and 2.4 of Lin and Young's paper: frequency response, mass m,
// damping b, stiffness k, and force sensor.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/analysis/identification.h"
#include "haptics/analysis/sensor_calibration.h"
#include "haptics/loop/preset.h"

namespace gearshift::lab {

struct AxisIdentification {
  haptics::FrequencyResponse response;
  haptics::AxisFit fit;
  haptics::AxisModel nominal;       // the axis as the device's spec() describes it
  double nominal_friction = 0.0;    // [N] the simulated lever's dry friction
  haptics::FrequencyPoint literal;  // measured at 1 Hz with the paper's amplitude, even if that exceeds the stroke
};

struct Identification {
  haptics::DeviceSpec spec;
  double rate = 0.0;  // [Hz]
  std::vector<AxisIdentification> axes;
  haptics::ForceSensorModel sensor;  // the preset's sensor
  haptics::SensorCalibration calibration;
};

using IdentifyProgress = std::function<void(std::string_view what, double fraction)>;

// Frequency sweep for a preset, downwards to 0.2 Hz. It starts at the paper's highest frequency, 65 Hz, or at a quarter
// of the preset's rate if that is lower.
haptics::SweepConfig preset_sweep(const haptics::Preset& preset);

// Sweeps one axis of the preset's lever without a hand. Each call simulates a new lever, so sweeps are independent.
haptics::FrequencyResponse sweep_lever(const haptics::Preset& preset, haptics::LeverAxis axis,
                                       const haptics::SweepConfig& config, const haptics::SweepProgress& progress = {});

// Sweeps one axis with preset_sweep() and fits m, b and k. Throws std::runtime_error with one sentence if the sweep
// ended early or the fit failed.
AxisIdentification identify_axis(const haptics::Preset& preset, haptics::LeverAxis axis,
                                 const haptics::SweepProgress& progress = {});

// Identifies the given axes and calibrates the force sensor. Throws like identify_axis().
Identification identify_lever(const haptics::Preset& preset, const std::vector<haptics::LeverAxis>& axes,
                              const IdentifyProgress& progress = {});

// Writes bode_AXIS.csv with the test points, and bode_AXIS.svg and .png with a plot like the paper's Fig. 4, to an
// existing folder. `nominal`: label of the pale curve, which shows `axis.nominal`. `waiting`: called while gnuplot
// works. Throws std::runtime_error or FileError.
void draw_bode(const std::filesystem::path& folder, const AxisIdentification& axis, std::string_view nominal,
               const std::function<void()>& waiting);

// Both functions format the result for `gearshift identify`.
std::string identification_table(const Identification& found);
std::string identification_json(const Identification& found);

}  // namespace gearshift::lab
