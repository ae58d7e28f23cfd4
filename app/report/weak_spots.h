// What goes wrong, how often, and whether it becomes less.
//
// This work is based on:
// J. Przyborowski, H. Wilenski. Homogeneity of Results in Testing Samples from Poisson Series. 1940
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "app/report/learner_history.h"

namespace gearshift {

enum class Trend { unknown, falling, unclear, rising };  // unknown: no shifts to compare

struct WeakSpot {
  FaultKind kind = FaultKind::stall;
  std::array<std::size_t, 4> by_severity{};  // note, minor, severe, very severe
  std::size_t count = 0;
  double points = 0.0;                 // [1] taken off in all
  double earlier = 0.0, lately = 0.0;  // per 10 shifts, in the earlier and in the later half of the shifts
  double per_ten = 0.0;                // per 10 shifts, in all; 0 where there are none
  Trend trend = Trend::unknown;
  std::optional<DriveFault> newest_step;  // the newest of them that names a step of the lesson
};

struct Weaknesses {
  std::size_t shifts = 0;       // that they were counted in
  std::vector<WeakSpot> spots;  // the most points first
};

// Of graded runs alone. Halves are cut between two runs.
Weaknesses weaknesses(const LearnerHistory& history);

// Of `before` events in `shifts_before` shifts and `after` in `shifts_after`: rising or falling where as few or as many
// of them would fall into the later part with a chance below 5 % if nothing had changed. Then each event falls there
// with the chance shifts_after / all shifts: a binomial tail.
Trend trend_of(std::size_t before, std::size_t shifts_before, std::size_t after, std::size_t shifts_after) noexcept;

}  // namespace gearshift
