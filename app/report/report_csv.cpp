// This work is based on:
// Y. Shafranovich. RFC 4180, Common Format and MIME Type for Comma-Separated Values (CSV) Files. 2005
#include "app/report/report_csv.h"

#include <array>
#include <cstddef>
#include <initializer_list>
#include <map>

#include <fmt/format.h>

#include "app/report/progress.h"
#include "app/report/words.h"
#include "app/training/shift_fields.h"

namespace gearshift {
namespace {

// Of a fault's value, in the order of FaultKind.
constexpr std::array<std::string_view, kFaultKinds> kUnits{
    "rad/s", "rad/s", "s", "W", "s", "s", "rad/s", "s",     "s",     "rad/s", "rad/s", "J", "s",
    "gear",  "gear",  "1", "N", "1", "m", "m/s^3", "rad/s", "rad/s", "s",     "m/s",   "s"};

// Line by line; the first one names the columns.
class Table {
 public:
  Table& text(std::string_view field) {
    if (!first_) text_ += ',';
    first_ = false;
    text_ += csv_field(field);
    return *this;
  }
  template <class Number>
  Table& number(Number value) {
    return text(fmt::format("{}", value));
  }
  Table& flag(bool on) { return text(on ? "1" : "0"); }
  Table& texts(std::initializer_list<std::string_view> fields) {
    for (const std::string_view field : fields) text(field);
    return *this;
  }
  void end() {
    text_ += "\r\n";
    first_ = true;
  }
  std::string take() && { return std::move(text_); }

 private:
  std::string text_;
  bool first_ = true;
};

std::string comments_text(const std::vector<CommentRow>& comments) {
  std::string text;
  for (const CommentRow& comment : comments) {
    text += fmt::format("{}{}, {}: {}", text.empty() ? "" : "\n", comment.author, comment.at, comment.text);
  }
  return text;
}

std::string steps_text(const std::vector<ShiftStep>& steps) {
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

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string runs_csv(const LearnerHistory& history) {
  Table table;
  table.texts({"run",    "session",    "learner",   "begun_at_utc", "lesson",        "task",
               "mode",   "guided",     "whole",     "ended",        "begin_s",       "duration_s",
               "grade",  "points_off", "passed",    "why",          "slip_energy_j", "engine_work_j",
               "shifts", "faults",     "recording", "comments"});
  table.end();
  for (const ReportedRun& run : history.runs) {
    const LessonResult& result = run.row.result;
    table.number(run.row.id).number(run.row.session).text(history.learner.name).text(run.row.begun_at);
    table.text(result.lesson).text(result.task).text(lesson_mode_key(result.mode));
    table.flag(result.guided).flag(result.whole).text(lesson_end_key(result.end));
    table.number(result.begin).number(result.duration);
    is_graded(result) ? table.number(result.grade) : table.text("");
    table.number(points_off(result)).flag(result.passed).text(result.why);
    table.number(result.slip_energy).number(result.fuel).number(result.shifts.size()).number(result.faults.size());
    table.text(run.row.recording).text(comments_text(run.comments)).end();
  }
  return std::move(table).take();
}

std::string shifts_csv(const LearnerHistory& history) {
  Table table;
  table.texts({"run", "shift", "from_gear", "to_gear", "guided", "missed", "steps"});
  const ShiftRecord none;
  each_figure(none, [&](const char* name, const auto&) { table.text(name); });
  table.end();
  for (const ReportedRun& run : history.runs) {
    for (const ShiftRecord& shift : run.row.result.shifts) {
      table.number(run.row.id).number(shift.number).text(gear_name(shift.from)).text(gear_name(shift.to));
      table.flag(shift.guided).flag(shift.missed).text(steps_text(shift.steps));
      each_figure(shift, [&](const char*, const auto& value) { table.number(value); });
      table.end();
    }
  }
  return std::move(table).take();
}

std::string faults_csv(const LearnerHistory& history) {
  Table table;
  table.texts({"run", "fault", "kind", "severity", "time_s", "value", "unit", "shift", "points", "step", "wanted_s"});
  table.end();
  for (const ReportedRun& run : history.runs) {
    const LessonResult& result = run.row.result;
    std::map<std::size_t, double> points;
    for (const Deduction& deduction : result.deductions) points[deduction.fault] += deduction.points;
    for (std::size_t i = 0; i < result.faults.size(); ++i) {
      const DriveFault& fault = result.faults[i];
      table.number(run.row.id).number(i).text(fault_key(fault.kind)).text(severity_key(fault.severity));
      table.number(fault.time).number(fault.value).text(kUnits[static_cast<std::size_t>(fault.kind)]);
      fault.shift >= 0 ? table.number(fault.shift) : table.text("");
      table.number(points[i]).text(fault.step);
      fault.step.empty() ? table.text("") : table.number(fault.wanted);
      table.end();
    }
  }
  return std::move(table).take();
}

}  // namespace gearshift
