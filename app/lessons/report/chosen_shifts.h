// Chooses the shifts worth looking at: those that cost most points and the best ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

inline constexpr std::size_t kMaxChosenShifts = 3;  // for each of worst and best

struct ChosenShift {
  std::int64_t run = 0;
  std::string lesson;     // key
  std::string recording;  // trace file, or empty
  ShiftRecord shift;
  std::vector<DrivingError> errors;  // in this shift
  double points = 0.0;               // [1] deducted for them
};

struct ChosenShifts {
  std::vector<ChosenShift> worst;  // most points first; then missed, then most faults, then latest
  std::vector<ChosenShift> best;   // from gear to gear without any flaw, quickest first
};

// Considers graded runs only. The worst exclude shifts without deductions, misses and faults. The best exclude shifts
// with a fault or note, a step out of order, the lever before the clutch, the clutch before the gear, a block, a grind
// or a wrong slot.
ChosenShifts choose_shifts(const LearnerHistory& history);

}  // namespace gearshift::lessons
