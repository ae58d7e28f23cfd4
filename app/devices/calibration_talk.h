// A calibration as a talk with the person at the stick: every step says what will happen before it begins; what it found is
// told and kept; nonsense is told and asked for again. A script can answer as well.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "haptics/hardware/calibrator.h"

namespace gearshift {

// No answer will come any more, or the program was asked to end: one sentence.
class CalibrationEnded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct CalibrationTalk {
  std::function<void(const std::string& line)> say;
  std::function<std::string(const std::string& question)> ask;  // a line; throws CalibrationEnded
  std::function<void(const DeviceCalibration&)> keep;           // after each step
};

// How long a person has [s].
struct CalibrationTimes {
  double axis = 4.0;    // to push the lever to a side
  double range = 10.0;  // to move it to all its ends, the last second without a hand
  double button = 6.0;  // to press one
};

// The steps that are missing yet, in their order. springs: the stick makes springs. Throws what ask and keep throw.
void calibrate(Calibrator& calibrator, bool springs, const CalibrationTalk& talk, const CalibrationTimes& times = {});

}  // namespace gearshift
