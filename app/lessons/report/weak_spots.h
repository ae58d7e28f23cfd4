// Finds the driving errors that cost most, and their trends.
//
// This work is based on:
// Ronald Fisher. The Logic of Inductive Inference. 1935
// Pierre-Simon Laplace. Essai philosophique sur les probabilites. 1814 (rule of succession)
// Cyrus Mehta, Nitin Patel, Robert Gray. Computing an Exact Confidence Interval for the Common Odds Ratio in Several
// 2x2 Contingency Tables. 1985
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "app/lessons/report/learner_history.h"

namespace gearshift::lessons {

// unknown: the compared runs lack the error. gone: none in so many latest runs that, if it were still as frequent as
// before, this would have a chance below 5 % (clean_run_chance); in simulated histories without any change, at most 12 %
// of the errors are called gone.
enum class Trend { unknown, gone, falling, unclear, rising };

struct WeakSpot {
  ErrorKind kind = ErrorKind::stall;
  std::array<std::size_t, 4> by_severity{};  // number of errors by severity: note, minor, severe, very severe
  std::size_t count = 0;
  double points = 0.0;  // [1] total deduction in graded runs
  // [1] runs with the error per 10 runs, in the first half (`earlier`) and the second half (`recent`) of each lesson's
  // runs
  double earlier = 0.0, recent = 0.0;
  double per_ten = 0.0;    // [1] errors per 10 shifts, without notes; 0 if there were no shifts
  std::size_t graded = 0;  // number of errors in graded runs, without notes
  std::size_t clean = 0;   // latest graded runs without the error, among those of the lessons that ever had it
  Trend trend = Trend::unknown;
  std::optional<DrivingError> newest_step;  // newest error that names a step of the lesson
};

struct Weaknesses {
  std::size_t shifts = 0;       // number of shifts considered
  std::vector<WeakSpot> spots;  // most points first, those that are gone last
};

// Counts the errors of every run that ended with all its data, guided runs and those given up included. Trends consider
// graded runs only. The runs of each lesson are split into halves (without the middle run of an odd number),
// so that a different mix of lessons does not count as a change. A run counts once per kind of error. Notes do not
// count.
Weaknesses weaknesses(const LearnerHistory& history);

// Chance [1] of `clean` runs without the error after `with` of `runs` runs with it, if nothing has changed: the product of
// the rule of succession, (runs - with + 1 + i) / (runs + 2 + i) for i from 0 to clean - 1.
double clean_run_chance(std::size_t with, std::size_t runs, std::size_t clean) noexcept;

// For one lesson: the number of runs in each half, and how many runs of each half had the error.
struct LessonHalves {
  std::size_t runs = 0, earlier = 0, recent = 0;  // `earlier` and `recent` are at most `runs`
};

// Tests the hypothesis of no change: within each lesson, every run is equally likely to have the error. Each lesson's
// later half is then a draw without replacement, and the draws of all lessons add up. The trend is rising or falling if
// the observed number of later runs with the error, or a more extreme number, has a probability below 5 % under this
// hypothesis.
Trend trend_of(std::span<const LessonHalves> lessons);

}  // namespace gearshift::lessons
