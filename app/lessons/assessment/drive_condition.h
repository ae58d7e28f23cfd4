// Evaluates the conditions of a lesson.
#pragma once

#include "app/lessons/assessment/lesson.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Inputs of a condition that a single sample does not contain.
struct DriveProgress {
  double distance = 0.0;     // [m] driven forward since the lesson began
  double rolled_back = 0.0;  // [m] rolled back since the step began
};

bool holds(const DriveCondition& condition, const vehicle::DriveSample& sample, const DriveProgress& progress) noexcept;

// True if the condition has no terms and would therefore always hold.
bool is_empty(const DriveCondition& condition) noexcept;

// A condition that must hold for some time.
class HeldCondition {
 public:
  // True once the condition has held continuously for its `held` time.
  bool update(const DriveCondition& condition, const vehicle::DriveSample& sample,
              const DriveProgress& progress) noexcept;
  void reset() noexcept { *this = HeldCondition(); }
  bool began_false() const noexcept { return began_false_; }  // false at the first sample after the reset

 private:
  bool on_ = false;
  bool first_ = true;
  bool began_false_ = false;
  double since_ = 0.0;  // [s]
};

}  // namespace gearshift::lessons
