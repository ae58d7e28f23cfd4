// Keys of files and enumerations, in words for people.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/training/lesson.h"
#include "app/training/lesson_result.h"

namespace gearshift {

std::string plain_words(std::string_view key);               // "Moving off" for "moving_off"
std::string_view lesson_end_key(LessonEnd end) noexcept;     // "out_of_time"
std::string_view lesson_mode_key(LessonMode mode) noexcept;  // "follow_me"

// Its title, or its key in words where the lesson is not known any more.
std::string lesson_title(std::span<const Lesson> lessons, std::string_view key);

// What the task is called: the title of the first lesson that teaches it; else its key in words.
std::string task_title(std::span<const Lesson> lessons, std::string_view task);

// Whose key is one of these: what an instructor chose, and the coach offers.
bool is_lesson(std::span<const Lesson> lessons, std::string_view key);

// With that many digits and a true minus sign; no minus before a nought.
std::string number_words(double value, int digits);

std::string gear_change(const ShiftRecord& shift);  // "2 → 3"

}  // namespace gearshift
