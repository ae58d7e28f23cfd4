// Chooses the shifts worth looking at: those that cost the most points, and the best ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

inline constexpr std::size_t kMaxChosenShifts = 3;  // largest size of `worst` and of `best`

struct ChosenShift {
  std::int64_t run = 0;
  std::string lesson;     // key
  std::string recording;  // trace file, or empty
  ShiftRecord shift;
  std::vector<DrivingError> errors;  // errors in this shift
  double points = 0.0;               // [1] points deducted for these errors
};

struct ChosenShifts {
  std::vector<ChosenShift> worst;  // most points lost first; if equal: missed first, then most errors, then latest
  std::vector<ChosenShift> best;   // from gear to gear without any flaw, quickest first
};

// Considers graded runs only. `worst` contains only shifts with a deduction, a miss or an error. `best` contains no
// shift with an error or note, a step out of order, blocking long enough to be an error, grinding or a wrong slot. In
// `best`, the clutch was down before the lever moved, and came up after the gear was in.
ChosenShifts choose_shifts(const LearnerHistory& history);

}  // namespace gearshift::lessons
