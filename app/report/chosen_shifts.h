// The shifts that are worth looking at: what cost most, and what was done best.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "app/report/learner_history.h"

namespace gearshift {

inline constexpr std::size_t kMostChosen = 3;  // of each kind

struct ChosenShift {
  std::int64_t run = 0;
  std::string lesson;     // key
  std::string recording;  // trace file, or empty
  ShiftRecord shift;
  std::vector<DriveFault> faults;  // of this shift
  double points = 0.0;             // [1] that they cost
};

struct ChosenShifts {
  std::vector<ChosenShift> worst;  // the most points first; then missed, then the most faults, then the latest
  std::vector<ChosenShift> best;   // from gear to gear, nothing wrong in it, the quickest first
};

// Of graded runs alone. A shift that cost nothing, missed nothing and has no fault is not among the worst. Among the best
// is none with a fault or a note, a step out of place, a lever before the clutch, a clutch before the gear, a block, a
// grind or a wrong slot.
ChosenShifts choose_shifts(const LearnerHistory& history);

}  // namespace gearshift
