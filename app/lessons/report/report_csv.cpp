#include "app/lessons/report/report_csv.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "app/base/csv.h"
#include "app/lessons/assessment/shift_fields.h"
#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"

namespace gearshift::lessons {
namespace {

struct ErrorUnit {
  std::string_view key, unit;
};

// Units of the errors' values by error key, so that a new kind of error does not shift the units of other errors.
constexpr ErrorUnit kUnits[] = {
    {"stall", "rad/s"},        {"over_rev", "rad/s"},    {"lugging", "s"},
    {"clutch_dump", "W"},      {"clutch_early", "s"},    {"clutch_late", "s"},
    {"no_clutch", "rad/s"},    {"riding_clutch", "s"},   {"riding_lever", "s"},
    {"rev_mismatch", "rad/s"}, {"grind", "J"},           {"throttle_in_shift", "rad/s"},
    {"blocked", "s"},          {"missed_shift", "gear"}, {"wrong_gear", "gear"},
    {"wrong_column", "1"},     {"over_push", "N"},       {"step_order", "1"},
    {"rollback", "m"},         {"jerk", "m/s^3"},        {"early_shift", "rad/s"},
    {"late_shift", "rad/s"},   {"too_slow", "s"},        {"wrong_direction", "m/s"},
    {"slow_step", "s"},        {"coasting", "s"},        {"early_downshift", "rad/s"},
    {"clutch_burn", "J"},
};

std::string_view unit_of(ErrorKind kind) noexcept {
  const auto found = std::find_if(std::begin(kUnits), std::end(kUnits),
                                  [key = to_string(kind)](const ErrorUnit& of) { return of.key == key; });
  return found != std::end(kUnits) ? found->unit : std::string_view();
}

std::string comments_text(const std::vector<CommentRow>& comments) {
  std::string text;
  for (const CommentRow& comment : comments) {
    text += fmt::format("{}{}, {}: {}", text.empty() ? "" : "\n", comment.author, comment.at, comment.text);
  }
  return text;
}

std::string format_steps(const std::vector<ShiftStep>& steps) {
  constexpr std::array<std::string_view, 6> kNames{"throttle_off", "clutch_down", "neutral",
                                                   "gear",         "clutch_up",   "throttle_on"};
  std::string text;
  for (const ShiftStep step : steps) {
    if (!text.empty()) text += ' ';
    text += kNames[static_cast<std::size_t>(step)];
  }
  return text;
}

double points_off(const LessonResult& result) {
  double points = 0.0;
  for (const Deduction& deduction : result.deductions) points += deduction.points;
  return points;
}

}  // namespace

std::string runs_csv(const LearnerHistory& history) {
  base::CsvTable table;
  table.texts({"run",    "session",    "learner",   "begun_at_utc", "lesson",        "task",
               "mode",   "guided",     "whole",     "ended",        "begin_s",       "duration_s",
               "grade",  "points_off", "passed",    "why",          "slip_energy_j", "engine_work_j",
               "shifts", "faults",     "recording", "comments"});
  table.end();
  for (const ReportedRun& run : history.runs) {
    const LessonResult& result = run.row.result;
    table.number(run.row.id).number(run.row.session).text(history.learner.name).text(run.row.begun_at);
    table.text(result.lesson).text(result.task).text(to_string(result.mode));
    table.flag(result.guided).flag(result.is_complete).text(to_string(result.end));
    table.number(result.begin).number(result.duration);
    is_graded(result) ? table.number(result.grade) : table.text("");
    table.number(points_off(result)).flag(result.passed).text(result.why);
    table.number(result.slip_energy).number(result.fuel).number(result.shifts.size()).number(result.errors.size());
    table.text(run.row.recording).text(comments_text(run.comments)).end();
  }
  return std::move(table).take();
}

std::string shifts_csv(const LearnerHistory& history) {
  base::CsvTable table;
  table.texts({"run", "shift", "from_gear", "to_gear", "guided", "missed", "steps"});
  const ShiftRecord none;
  each_figure(none, [&](const char* name, const auto&) { table.text(name); });
  table.end();
  for (const ReportedRun& run : history.runs) {
    for (const ShiftRecord& shift : run.row.result.shifts) {
      table.number(run.row.id)
          .number(shift.number + 1)
          .text(haptics::gear_name(shift.from))
          .text(haptics::gear_name(shift.to));
      table.flag(shift.guided).flag(shift.missed).text(format_steps(shift.steps));
      each_figure(shift, [&](const char*, const auto& value) { table.number(value); });
      table.end();
    }
  }
  return std::move(table).take();
}

std::string errors_csv(const LearnerHistory& history) {
  base::CsvTable table;
  table.texts({"run", "fault", "kind", "severity", "time_s", "value", "unit", "shift", "points", "step", "wanted_s"});
  table.end();
  for (const ReportedRun& run : history.runs) {
    const LessonResult& result = run.row.result;
    std::map<std::size_t, double> points;
    for (const Deduction& deduction : result.deductions) points[deduction.error] += deduction.points;
    for (std::size_t i = 0; i < result.errors.size(); ++i) {
      const DrivingError& error = result.errors[i];
      table.number(run.row.id).number(i + 1).text(to_string(error.kind)).text(to_string(error.severity));
      table.number(error.time).number(error.value).text(unit_of(error.kind));
      error.shift >= 0 ? table.number(error.shift + 1) : table.text("");
      table.number(points[i]).text(error.step);
      error.step.empty() ? table.text("") : table.number(error.wanted);
      table.end();
    }
  }
  return std::move(table).take();
}

}  // namespace gearshift::lessons
