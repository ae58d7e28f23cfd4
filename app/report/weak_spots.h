// What goes wrong, how often, and whether it becomes less.
//
// This work is based on:
// Ronald Fisher. The Logic of Inductive Inference. 1935
// Cyrus Mehta, Nitin Patel, Robert Gray. Computing an Exact Confidence Interval for the Common Odds Ratio in Several
// 2x2 Contingency Tables. 1985
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "app/report/learner_history.h"

namespace gearshift {

enum class Trend { unknown, falling, unclear, rising };  // unknown: not in the runs that are compared

struct WeakSpot {
  FaultKind kind = FaultKind::stall;
  std::array<std::size_t, 4> by_severity{};  // note, minor, severe, very severe
  std::size_t count = 0;
  double points = 0.0;                 // [1] taken off in all
  double earlier = 0.0, lately = 0.0;  // of 10 runs so many had it, in the first and the second half of each lesson's
  double per_ten = 0.0;                // per 10 shifts, in all, without notes; 0 where there are none
  Trend trend = Trend::unknown;
  std::optional<DriveFault> newest_step;  // the newest of them that names a step of the lesson
};

struct Weaknesses {
  std::size_t shifts = 0;       // that they were counted in
  std::vector<WeakSpot> spots;  // the most points first
};

// Of graded runs alone. Halves are those of each lesson's runs, the middle one of an odd number left out: which lessons
// were driven when is no change. A run has a fault or has not, however often; a note is none.
Weaknesses weaknesses(const LearnerHistory& history);

// Of one lesson: `runs` in each half, of which so many had the fault.
struct LessonHalves {
  std::size_t runs = 0, earlier = 0, lately = 0;  // earlier, lately <= runs
};

// Rising or falling where as few or as many later runs would have it with a chance below 5 % if nothing had changed: if
// within each lesson any run were as likely to be one of those. So each lesson's later half draws from its runs without
// putting back, and what the lessons draw adds up.
Trend trend_of(std::span<const LessonHalves> lessons);

}  // namespace gearshift
