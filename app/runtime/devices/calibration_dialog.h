// Calibrates a stick in a dialog with the user. Each step announces what will happen, then prints and saves its result;
// a step with an invalid result is repeated. A script can answer instead of the user.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "haptics/hardware/calibrator.h"

namespace gearshift::runtime {

// Thrown when the input has ended or the program was asked to stop. what() is one sentence.
class CalibrationEnded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct CalibrationDialog {
  std::function<void(const std::string& line)> print;
  std::function<std::string(const std::string& question)> ask;  // returns one line or throws CalibrationEnded
  std::function<void(const haptics::DeviceCalibration&)> save;  // called after each step
};

// Time limits for the user. [s]
struct CalibrationTimes {
  double axis = 4.0;    // time to push the lever to one side
  double range = 10.0;  // time to move the lever along all its stops and release it before the last second
  double button = 6.0;  // time to press a button
};

// Runs the missing steps in order. `ability`: what the stick can do. Passes on exceptions from `ask` and `save`.
void calibrate(haptics::Calibrator& calibrator, const haptics::PidAbility& ability, const CalibrationDialog& dialog,
               const CalibrationTimes& times = {});

}  // namespace gearshift::runtime
