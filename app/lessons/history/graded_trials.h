// The graded trials among a learner's runs, and the breaks before them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/lessons/assessment/suggest.h"
#include "app/lessons/history/history.h"

namespace gearshift::lessons {

// Time between the begin of two runs of a lesson [s], if it is at least kRetentionPause; else empty. Times are in
// seconds since 1970; empty: unreadable.
std::optional<double> retention_pause(std::optional<std::int64_t> before, std::optional<std::int64_t> now) noexcept;

// The graded trials among these runs, both oldest first. `pause` is the break since the previous run of the same lesson,
// graded or not; runs that ended early or never ended are ignored.
std::vector<GradedTrial> graded_trials(std::span<const RunRow> runs);

// The other runs that ended, by the learner or at their end, oldest first.
std::vector<UngradedTrial> ungraded_trials(std::span<const RunRow> runs);

}  // namespace gearshift::lessons
