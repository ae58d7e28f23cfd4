#include "app/ui/panel/lesson_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/lessons/assessment/grade.h"
#include "app/ui/panel/format_value.h"
#include "app/ui/panel/palette.h"
#include "haptics/files/ascii.h"
#include "haptics/files/parameter.h"

namespace gearshift::ui {

std::string_view lesson_title(const lessons::CoachView& coach, std::string_view key) {
  const auto found = std::find_if(coach.lessons.begin(), coach.lessons.end(),
                                  [&](const lessons::LessonStanding& lesson) { return lesson.key == key; });
  return found == coach.lessons.end() ? key : found->title;
}

std::string format_verdict(const lessons::LessonResult& result) {
  if (result.end == lessons::LessonEnd::left) return "left early";
  if (result.end == lessons::LessonEnd::running) return "cut off";  // the program ended during the run
  if (result.guided) return "guided";
  if (!result.is_complete) return "data lost";
  return fmt::format("{:.1f}", result.grade);
}

ImU32 verdict_colour(const lessons::LessonResult& result) {
  if (!lessons::is_graded(result)) return ink::kSoft;
  return result.passed ? ink::kGood : ink::kBad;
}

ImU32 severity_colour(lessons::Severity severity) {
  switch (severity) {
    case lessons::Severity::note:
      return ink::kSoft;
    case lessons::Severity::minor:
      return ink::kWarn;
    case lessons::Severity::severe:
    case lessons::Severity::very_severe:
      return ink::kBad;
  }
  return ink::kSoft;
}

std::string_view take_advice(const lessons::DrivingError& error, ErrorKinds& advised) {
  const std::size_t kind = static_cast<std::size_t>(error.kind);
  if (error.severity == lessons::Severity::note || advised[kind]) return {};
  advised.set(kind);
  return lessons::error_advice(error.kind);
}

std::string format_gears(const lessons::ShiftRecord& shift) {
  return fmt::format("{} \u2192 {}", haptics::gear_name(shift.from), haptics::gear_name(shift.to));
}

std::string format_rpm(double speed) {
  return format_value(speed / haptics::kTurnPerMinute, "rpm", 0);
}

std::string format_local_time(const std::string& utc) {
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

std::string format_time_zone(std::time_t now) {
  std::tm here{};
  std::array<char, 64> text{};
  if (localtime_r(&now, &here) == nullptr || std::strftime(text.data(), text.size(), "%z", &here) != 5) return "UTC";
  const std::string offset(text.data());
  return fmt::format("UTC{}:{}", offset.substr(0, 3), offset.substr(3));
}

std::string readable_name(std::string_view key) {
  static constexpr std::pair<std::string_view, std::string_view> kShippedGates[] = {
      {"four_speed", "4-speed"},
      {"dog_leg_five", "Dog-leg 5-speed"},
      {"five_speed_r_left_up", "5-speed, R top left"},
      {"five_speed_r_right_down", "5-speed, R bottom right"},
      {"six_speed_r_left_up", "6-speed, R top left"},
      {"six_speed_r_left_down", "6-speed, R bottom left"},
      {"six_speed_r_right_down", "6-speed, R bottom right"},
      {"six_speed_r_left_spring", "6-speed, R behind a spring"},
      {"open_gate_six", "6-speed, open gate"},
      {"seven_speed", "7-speed"}};
  for (const auto& [gate, title] : kShippedGates)
    if (key == gate) return std::string(title);
  std::string words(key);
  std::replace(words.begin(), words.end(), '_', ' ');
  if (!words.empty()) words[0] = haptics::ascii_upper(words[0]);
  return words;
}

}  // namespace gearshift::ui
