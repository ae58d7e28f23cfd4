// Texts and colours for lessons, shared by card, list and history.
#pragma once

#include <imgui.h>

#include <bitset>
#include <ctime>
#include <string>
#include <string_view>

#include "app/lessons/coach/coach_view.h"

namespace gearshift::ui {

// Returns an unknown key unchanged. The text belongs to the view or is the key.
std::string_view lesson_title(const lessons::CoachView& coach, std::string_view key);

std::string format_verdict(const lessons::LessonResult& result);  // "7.5", or why ungraded: "guided", "data lost"
ImU32 verdict_colour(const lessons::LessonResult& result);
ImU32 severity_colour(lessons::Severity severity);

// Returns the advice to show below the error: none for a note, and once per kind. Adds the kind to `advised`.
using ErrorKinds = std::bitset<lessons::kErrorKindCount>;
std::string_view take_advice(const lessons::DrivingError& error, ErrorKinds& advised);

std::string format_gears(const lessons::ShiftRecord& shift);  // "1 → 2"
std::string format_rpm(double speed);                         // speed [rad/s]

// Converts a UTC time such as "2026-01-02T10:00:00Z" to local time, for example "2026-01-02 11:00". Any other text is
// returned unchanged.
std::string format_local_time(const std::string& utc);
std::string format_time_zone(std::time_t now);  // the local time zone: "UTC+01:00"

// Converts a file name to display text: "my_own_gate" becomes "My own gate". The shipped gates have their own titles.
std::string readable_name(std::string_view key);

}  // namespace gearshift::ui
