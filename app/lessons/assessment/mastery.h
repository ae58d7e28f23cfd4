// Mastery of a lesson takes two passes, because one may be luck, or a good day.
#pragma once

#include <span>
#include <string_view>

#include "app/lessons/assessment/suggest.h"

namespace gearshift::lessons {

enum class Mastery {
  not_passed,
  passed_once,  // or more often, but always on one day and without another lesson between
  mastered      // passed twice, the second time on another day (UTC) or after a graded trial of another lesson
};

// `past`: the learner's graded trials, oldest first.
Mastery mastery_of(std::span<const GradedTrial> past, std::string_view lesson);

// Text for the learner, for example "Passed once. Pass it again tomorrow or after another lesson."
std::string_view mastery_sentence(Mastery mastery) noexcept;

}  // namespace gearshift::lessons
