// What card, list and history say of lessons in the same words and colours.
#pragma once

#include <imgui.h>

#include <ctime>
#include <string>

#include "app/coach/coach_view.h"

namespace gearshift {

std::string lesson_title(const CoachView& coach, const std::string& key);  // the key itself where nobody knows it

bool shows_grade(const LessonResult& result);           // graded, and driven to an end
std::string verdict_words(const LessonResult& result);  // "7.5", or why there is no grade: "guided", "left", "lost"
ImU32 verdict_colour(const LessonResult& result);
ImU32 severity_colour(Severity severity);

double points_of_fault(const LessonResult& result, std::size_t fault);  // [1] of 10 that it took off; 0: none

std::string gears_words(const ShiftRecord& shift);  // "1 → 2"
std::string rpm_words(double speed);                // [rad/s]

// "2026-01-02T10:00:00Z" as the wall clock here says it, "2026-01-02 11:00"; what is no such time as it is.
std::string local_time_words(const std::string& utc);
std::string time_zone_words(std::time_t now);  // of those times: "UTC+01:00"

// A file's name as people read it: "dog_leg_five" is "Dog leg five".
std::string readable_name(const std::string& key);

}  // namespace gearshift
