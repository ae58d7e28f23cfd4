// Lesson results in which every number is different.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/history/history.h"

namespace gearshift::test {

inline lessons::ShiftRecord some_shift(std::int64_t number) {
  lessons::ShiftRecord shift;
  shift.number = number;
  shift.from = static_cast<int>(number % 5);
  shift.to = shift.from + 1;
  shift.guided = number % 2 == 1;
  shift.missed = number % 3 == 1;
  shift.steps = {lessons::ShiftStep::clutch_down, lessons::ShiftStep::throttle_off, lessons::ShiftStep::gear,
                 lessons::ShiftStep::clutch_up};
  int n = 0;
  lessons::each_field(shift, [&](const lessons::RecordField& field, auto& value) {
    if constexpr (std::is_same_v<decltype(value), double&>) value = static_cast<double>(number) + 1.0 / ++n;
    if constexpr (std::is_same_v<decltype(value), int&>) value = field.is_gear ? value : ++n;
  });
  return shift;
}

inline lessons::LessonResult some_result(int shifts) {
  lessons::LessonResult result;
  result.lesson = "hill_start";
  result.task = "moving_off";
  result.mode = lessons::LessonMode::by_yourself;
  result.end = lessons::LessonEnd::done;
  result.begin = 12.5;
  result.duration = 34.25;
  result.grade = 7.5;
  result.passed = true;
  result.why = "It's \"why\"; DROP TABLE shift; --";
  result.slip_energy = 2020.5;
  result.figures = {31.5, 12.25, 0.125, std::nullopt, 1.0625, 4.5, 0.31};
  result.grading = lessons::Grading::norm;
  result.car = "hatchback";
  result.path_length = 0.25;
  result.lever_help = 0.5;
  result.pedal_help = 0.125;
  result.score = 0.75;
  result.errors = {make_driving_error(lessons::ErrorKind::stall, lessons::Severity::severe, 13.5, 36.6, -1),
                   make_driving_error(lessons::ErrorKind::rollback, lessons::Severity::minor, 14.5, 0.3, 0),
                   make_driving_error(lessons::ErrorKind::jerk, lessons::Severity::note, 15.5, 9.0, 0),
                   make_driving_error(lessons::ErrorKind::slow_step, lessons::Severity::note, 16.5, 4.0, 0)};
  result.errors[3].step = "Let the \"hand\" brake off.";
  result.errors[3].time_limit = 2.5;
  result.errors[0].points = 2.0;
  result.errors[1].points = 0.5;
  for (int i = 0; i < shifts; ++i) result.shifts.push_back(some_shift(i));
  return result;
}

// Each field of a record with a name and a value, as text.
template <class Record>
std::map<std::string, std::string> fields_of(const Record& record) {
  std::map<std::string, std::string> fields;
  lessons::each_field(record, [&](const lessons::RecordField& field, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    std::string& text = fields[field.name];
    if constexpr (std::is_enum_v<Value>)
      text = std::string(to_string(value));
    else if constexpr (std::is_same_v<Value, std::vector<lessons::ShiftStep>>)
      text = lessons::format_steps(value);
    else if constexpr (std::is_same_v<Value, std::optional<double>> || std::is_same_v<Value, std::optional<int>>)
      text = value ? fmt::format("{}", *value) : "none";
    else
      text = fmt::format("{}", value);
  });
  return fields;
}

inline void check_same(const lessons::ShiftRecord& a, const lessons::ShiftRecord& b) {
  CHECK(fields_of(a) == fields_of(b));
}

inline void check_same(const lessons::LessonResult& a, const lessons::LessonResult& b) {
  CHECK(fields_of(a) == fields_of(b));
  REQUIRE(a.shifts.size() == b.shifts.size());
  for (std::size_t i = 0; i < a.shifts.size(); ++i) check_same(a.shifts[i], b.shifts[i]);
  REQUIRE(a.errors.size() == b.errors.size());
  for (std::size_t i = 0; i < a.errors.size(); ++i) CHECK(fields_of(a.errors[i]) == fields_of(b.errors[i]));
}

// Writes a history with one run of Ada's. Returns her number.
inline std::int64_t write_one_run(const std::filesystem::path& file, int shifts) {
  lessons::History history(file);
  const std::int64_t ada = history.find_or_add_learner("Ada");
  history.end_run(history.begin_run(history.begin_session(ada, "1.0"), some_result(0), ""), some_result(shifts));
  return ada;
}

// Returns the comments on the learners' run with this number.
inline std::vector<lessons::CommentRow> comments_of(lessons::History& history, std::int64_t run) {
  for (const lessons::LearnerRow& learner : history.learners()) {
    for (const lessons::RunRow& row : history.runs(learner.id))
      if (row.id == run) return row.comments;
  }
  return {};
}

}  // namespace gearshift::test
