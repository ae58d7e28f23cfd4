// Converts keys, enumeration values and numbers to text for readers.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/lesson_result.h"

namespace gearshift::lessons {

std::string words_from_key(std::string_view key);  // for example "moving off" for "moving_off"
std::string title_from_key(std::string_view key);  // for example "Moving off" for "moving_off"

// The lesson's title, or its key as text if the lesson is unknown.
std::string lesson_title(std::span<const Lesson> lessons, std::string_view key);

// The title of the first lesson that teaches the task, else the key as text.
std::string task_title(std::span<const Lesson> lessons, std::string_view task);

// True if `key` is the key of one of the lessons. The instructor's choice may be a key that no lesson has.
bool is_lesson(std::span<const Lesson> lessons, std::string_view key);

// Formats the value with `digits` decimals and a typographic minus sign; zero has no sign.
std::string format_number(double value, int digits);

std::string format_pause(double seconds);  // for example "26 hours" or "8 days"

std::string gear_change(const ShiftRecord& shift);  // "2 → 3"

}  // namespace gearshift::lessons
