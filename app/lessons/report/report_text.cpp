#include "app/lessons/report/report_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "haptics/files/ascii.h"

namespace gearshift::lessons {

std::string words_from_key(std::string_view key) {
  std::string words(key);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string title_from_key(std::string_view key) {
  std::string words = words_from_key(key);
  if (!words.empty()) words[0] = haptics::ascii_upper(words[0]);
  return words;
}

std::string lesson_title(std::span<const Lesson> lessons, std::string_view key) {
  const auto found =
      std::find_if(lessons.begin(), lessons.end(), [&](const Lesson& lesson) { return lesson.key == key; });
  return found != lessons.end() ? found->title : title_from_key(key);
}

std::string task_title(std::span<const Lesson> lessons, std::string_view task) {
  const auto found =
      std::find_if(lessons.begin(), lessons.end(), [&](const Lesson& lesson) { return lesson.task == task; });
  return found != lessons.end() ? found->title : title_from_key(task);
}

bool is_lesson(std::span<const Lesson> lessons, std::string_view key) {
  return std::any_of(lessons.begin(), lessons.end(), [&](const Lesson& lesson) { return lesson.key == key; });
}

std::string format_number(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), digits);
  const bool is_nought = text.find_first_not_of("0.") == std::string::npos;
  return (value < 0.0 && !is_nought ? "−" : "") + text;
}

std::string format_pause(double seconds) {
  constexpr double kHour = 3600.0, kDay = 24.0 * kHour;  // [s]
  if (seconds < 2.0 * kDay) return fmt::format("{:.0f} hours", seconds / kHour);
  return fmt::format("{:.0f} days", seconds / kDay);
}

std::string gear_change(const ShiftRecord& shift) {
  return std::string(haptics::gear_name(shift.from)) + " → " + haptics::gear_name(shift.to);
}

}  // namespace gearshift::lessons
