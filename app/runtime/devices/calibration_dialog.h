// Calibrates a stick in a dialog with the user: each step says what will happen before it starts, prints and saves its
// result, and repeats after an invalid one. A script can answer as well.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "haptics/hardware/calibrator.h"

namespace gearshift::runtime {

// The input has ended, or the program was asked to stop: one sentence.
class CalibrationEnded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct CalibrationDialog {
  std::function<void(const std::string& line)> print;
  std::function<std::string(const std::string& question)> ask;  // returns one line; throws CalibrationEnded
  std::function<void(const haptics::DeviceCalibration&)> save;  // called after each step
};

// Time limits for the user. [s]
struct CalibrationTimes {
  double axis = 4.0;    // to push the lever to one side
  double range = 10.0;  // to move it along all its stops, hands off in the last second
  double button = 6.0;  // to press a button
};

// Runs the missing steps in order. springs: the stick renders springs. Throws whatever `ask` and `save` throw.
void calibrate(haptics::Calibrator& calibrator, bool springs, const CalibrationDialog& dialog,
               const CalibrationTimes& times = {});

}  // namespace gearshift::runtime
