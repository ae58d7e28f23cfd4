// When a condition of a lesson holds.
#pragma once

#include "app/training/drive_sample.h"
#include "app/training/lesson.h"
#include "haptics/gate/gate.h"

namespace gearshift {

// What a condition asks that one sample does not tell.
struct DriveProgress {
  double distance = 0.0;     // [m] since the lesson began, forward
  double rolled_back = 0.0;  // [m] since the step began
};

bool holds(const DriveCondition& condition, const DriveSample& sample, const DriveProgress& progress) noexcept;

// It names nothing: it would hold at once.
bool is_empty(const DriveCondition& condition) noexcept;

// Remembers for how long.
class HeldCondition {
 public:
  // True once it has held for `held` on end.
  bool update(const DriveCondition& condition, const DriveSample& sample, const DriveProgress& progress) noexcept;
  void reset() noexcept { *this = HeldCondition(); }
  bool began_false() const noexcept { return began_false_; }  // at the first sample since the reset

 private:
  bool on_ = false;
  bool first_ = true;
  bool began_false_ = false;
  double since_ = 0.0;  // [s]
};

}  // namespace gearshift
