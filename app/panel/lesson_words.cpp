#include "app/panel/lesson_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include <fmt/format.h>

#include "app/panel/palette.h"
#include "app/panel/value_text.h"
#include "app/training/grade.h"
#include "haptics/files/ascii.h"

namespace gearshift {

std::string lesson_title(const CoachView& coach, const std::string& key) {
  const auto found = std::find_if(coach.lessons.begin(), coach.lessons.end(),
                                  [&](const LessonStanding& lesson) { return lesson.key == key; });
  return found == coach.lessons.end() ? key : found->title;
}

bool shows_grade(const LessonResult& result) {
  return is_graded(result) && result.end != LessonEnd::left;
}

std::string verdict_words(const LessonResult& result) {
  if (result.end == LessonEnd::left) return "left";
  if (result.end == LessonEnd::running) return "cut off";  // the program ended in the middle of it
  if (result.guided) return "guided";
  if (!result.whole) return "lost";
  return fmt::format("{:.1f}", result.grade);
}

ImU32 verdict_colour(const LessonResult& result) {
  if (!shows_grade(result)) return ink::kSoft;
  return result.passed ? ink::kGood : ink::kBad;
}

ImU32 severity_colour(Severity severity) {
  switch (severity) {
    case Severity::note:
      return ink::kSoft;
    case Severity::minor:
      return ink::kWarn;
    case Severity::severe:
    case Severity::very_severe:
      return ink::kBad;
  }
  return ink::kSoft;
}

double points_of_fault(const LessonResult& result, std::size_t fault) {
  double points = 0.0;
  for (const Deduction& deduction : result.deductions) points += deduction.fault == fault ? deduction.points : 0.0;
  return points;
}

std::string gears_words(const ShiftRecord& shift) {
  return fmt::format("{} \u2192 {}", gear_name(shift.from), gear_name(shift.to));
}

std::string rpm_words(double speed) {
  return value_text(speed * 60.0 / (2.0 * std::numbers::pi), "rpm", 0);
}

std::string local_time_words(const std::string& utc) {
  std::tm parts{};
  if (std::sscanf(utc.c_str(), "%4d-%2d-%2dT%2d:%2d:%2d", &parts.tm_year, &parts.tm_mon, &parts.tm_mday, &parts.tm_hour,
                  &parts.tm_min, &parts.tm_sec) != 6)
    return utc;
  parts.tm_year -= 1900;
  parts.tm_mon -= 1;
  const std::time_t time = timegm(&parts);
  std::tm here{};
  if (localtime_r(&time, &here) == nullptr) return utc;
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", here.tm_year + 1900, here.tm_mon + 1, here.tm_mday, here.tm_hour,
                     here.tm_min);
}

std::string time_zone_words(std::time_t now) {
  std::tm here{};
  std::array<char, 64> text{};
  if (localtime_r(&now, &here) == nullptr || std::strftime(text.data(), text.size(), "%z", &here) != 5) return "UTC";
  const std::string offset(text.data());
  return fmt::format("UTC{}:{}", offset.substr(0, 3), offset.substr(3));
}

std::string readable_name(const std::string& key) {
  std::string words = key;
  std::replace(words.begin(), words.end(), '_', ' ');
  if (!words.empty()) words[0] = ascii_upper(words[0]);
  return words;
}

}  // namespace gearshift
