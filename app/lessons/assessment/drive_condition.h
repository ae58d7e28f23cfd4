// Evaluates the conditions of a lesson.
#pragma once

#include "app/lessons/assessment/lesson.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Inputs of a DriveCondition that are not part of a single sample.
struct DriveProgress {
  double distance = 0.0;     // [m] distance driven forward since the lesson began
  double rolled_back = 0.0;  // [m] distance rolled back since the step began
};

bool holds(const DriveCondition& condition, const vehicle::DriveSample& sample, const DriveProgress& progress) noexcept;

// True if the condition has no terms and would therefore always hold.
bool is_empty(const DriveCondition& condition) noexcept;

// Checks whether a condition has been true for long enough without a break.
class HeldCondition {
 public:
  // Returns true once the condition has been true without a break for `condition.held` seconds.
  bool update(const DriveCondition& condition, const vehicle::DriveSample& sample,
              const DriveProgress& progress) noexcept;
  void reset() noexcept { *this = HeldCondition(); }
  // True if the first sample after reset() did not meet the condition.
  bool began_false() const noexcept { return began_false_; }

 private:
  bool on_ = false;
  bool first_ = true;
  bool began_false_ = false;
  double since_ = 0.0;  // [s]
};

}  // namespace gearshift::lessons
