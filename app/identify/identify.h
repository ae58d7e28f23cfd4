// Sections 2.3 and 2.4 of the paper on the simulated lever of a preset: frequency response, m, b and k, force sensor.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/analysis/identification.h"
#include "haptics/analysis/sensor_calibration.h"
#include "haptics/loop/preset.h"

namespace gearshift {

struct AxisIdentification {
  FrequencyResponse response;
  AxisFit fit;
  AxisModel nominal;       // what spec() says of that axis
  FrequencyPoint literal;  // the paper's amplitude at 1 Hz, whatever the stroke
};

struct Identification {
  DeviceSpec spec;
  double rate = 0.0;  // [Hz]
  std::vector<AxisIdentification> axes;
  ForceSensorModel sensor;  // as the preset has it
  SensorCalibration calibration;
};

const char* lever_axis_name(LeverAxis axis) noexcept;  // "x", "y"

using IdentifyProgress = std::function<void(std::string_view what, double share)>;

// From the smaller of 65 Hz, where the paper stopped, and a quarter of the rate down to 0.2 Hz.
SweepConfig preset_sweep(const Preset& preset);

// One axis of the preset's lever swept, the hand off it; on a lever of its own, so that no sweep depends on another.
FrequencyResponse sweep_lever(const Preset& preset, LeverAxis axis, const SweepConfig& config,
                              const SweepProgress& progress = {});

// preset_sweep() of one axis, and what it says. Throws std::runtime_error in one sentence when the sweep ended early or
// no axis fits it.
AxisIdentification identify_axis(const Preset& preset, LeverAxis axis, const SweepProgress& progress = {});

// These axes, and the force sensor weighed. Throws as identify_axis.
Identification identify_lever(const Preset& preset, const std::vector<LeverAxis>& axes,
                              const IdentifyProgress& progress = {});

// bode_AXIS.csv with the test points and bode_AXIS.svg, .png as in Fig. 4, into a folder that exists. nominal: what the
// pale curve of axis.nominal is called. Throws std::runtime_error, FileError.
void draw_bode(const std::filesystem::path& folder, const AxisIdentification& axis, std::string_view nominal,
               const std::function<void()>& waiting);

// What the verb prints.
std::string identification_table(const Identification& found);
std::string identification_json(const Identification& found);

}  // namespace gearshift
