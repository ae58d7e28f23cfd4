// Chooses the shifts worth looking at: those that cost the most points, and the best ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

inline constexpr std::size_t kMaxChosenShifts = 3;  // for `worst` and for `best`

struct ChosenShift {
  std::int64_t run = 0;
  std::string lesson;     // key
  std::string recording;  // trace file, or empty
  ShiftRecord shift;
  std::vector<DrivingError> errors;  // errors in this shift
  double points = 0.0;               // [1] points deducted for these errors
};

struct ChosenShifts {
  std::vector<ChosenShift> worst;  // most points first; then missed, then most errors, then latest
  std::vector<ChosenShift> best;   // from gear to gear without any flaw, quickest first
};

// Considers graded runs only. The worst exclude shifts without deductions, misses and errors. The best exclude shifts
// with an error or note, a step out of order, the lever before the clutch, the clutch before the gear, a block, a grind
// or a wrong slot.
ChosenShifts choose_shifts(const LearnerHistory& history);

}  // namespace gearshift::lessons
