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

// Sweeps from the smaller of 65 Hz and a quarter of the preset's rate down to 0.2 Hz with the hand off the lever, and
// weighs the sensor. Throws std::runtime_error in one sentence when a sweep ended early or no axis fits it.
Identification identify_lever(const Preset& preset, const std::vector<LeverAxis>& axes,
                              const IdentifyProgress& progress = {});

// bode_AXIS.csv with the test points and bode_AXIS.svg, .png as in Fig. 4, into a folder that exists. Throws
// std::runtime_error, FileError.
void draw_bode(const std::filesystem::path& folder, const AxisIdentification& axis,
               const IdentifyProgress& progress = {});

// What the verb prints.
std::string identification_table(const Identification& found);
std::string identification_json(const Identification& found);

}  // namespace gearshift
