// Drives a script headless: a simulated hand and pedals, lever, loop and car on a virtual clock.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/lab/drive/drive_script.h"
#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/shift_record.h"
#include "app/vehicle/car_load.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_event.h"

namespace gearshift::lab {

struct ScriptedDriveConfig {
  vehicle::CarSpec car;
  haptics::GateLayout gate;
  vehicle::CarStart start;
  DriveScript script;
  std::uint64_t seed = 1;       // of the tooth positions
  double interval = 0.01;       // [s] between two samples, at least one cycle
  std::filesystem::path trace;  // empty: none
};

struct ScriptedDrive {
  std::vector<vehicle::DriveSample> samples;  // from the first to the last cycle
  std::vector<haptics::HapticEvent> events;
  std::vector<lessons::ShiftRecord> shifts;
  std::vector<lessons::DrivingError> errors;
};

// The same script gives the same drive, bit for bit. Throws std::invalid_argument if car, gate and start do not fit
// together, and FileError if the script does not fit the gate or the trace cannot be written.
ScriptedDrive drive_script(const ScriptedDriveConfig& config);

// Parses a start such as "gear=2,speed_km_per_h=50,engine=off". Without a gear, the car starts in `gear`. Throws
// std::invalid_argument with one sentence.
vehicle::CarStart parse_drive_start(const std::string& text, int gear);

}  // namespace gearshift::lab
