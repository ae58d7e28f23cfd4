#include "app/lessons/report/report_csv.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <type_traits>

#include <fmt/format.h>

#include "app/lessons/report/progress.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/standing.h"

namespace gearshift::lessons {
namespace {

std::string comments_text(const std::vector<CommentRow>& comments) {
  std::string text;
  for (const CommentRow& comment : comments) {
    text += fmt::format("{}{}, {}: {}", text.empty() ? "" : "\n", comment.author, comment.at, comment.text);
  }
  return text;
}

// Appends the field of a record. Shifts are counted from 1 in tables; a shift that does not exist is empty.
void add_field(base::CsvTable& table, const RecordField& field, const auto& value) {
  using Value = std::remove_cvref_t<decltype(value)>;
  if constexpr (std::is_same_v<Value, std::string>)
    table.text(value);
  else if constexpr (std::is_same_v<Value, std::vector<ShiftStep>>)
    table.text(format_steps(value));
  else if constexpr (std::is_same_v<Value, bool>)
    table.flag(value);
  else if constexpr (std::is_enum_v<Value>)
    table.text(to_string(value));
  else if constexpr (std::is_same_v<Value, std::int64_t>)
    value >= 0 ? table.number(value + 1) : table.text("");
  else if constexpr (std::is_same_v<Value, int>)
    field.is_gear ? table.text(haptics::gear_name(value)) : table.number(value);
  else if constexpr (std::is_same_v<Value, double>)
    table.number(value);
  else  // std::optional
    value ? add_field(table, field, *value) : void(table.text(""));
}

template <class Record>
void add_names(base::CsvTable& table) {
  each_field(Record(), [&](const RecordField& field, const auto&) { table.text(field.name); });
}

template <class Record>
void add_fields(base::CsvTable& table, const Record& record) {
  each_field(record, [&](const RecordField& field, const auto& value) { add_field(table, field, value); });
}

}  // namespace

std::string runs_csv(const LearnerHistory& history, const base::CsvFormat& format) {
  base::CsvTable table(format);
  table.texts({"run", "session", "learner", "begun_at_utc"});
  add_names<LessonResult>(table);
  table.texts({"points_off", "shifts", "errors", "recording", "comments"});
  table.end();
  for (const RunRow& run : history.runs) {
    const LessonResult& result = run.result;
    table.number(run.id).number(run.session).text(history.learner.name).text(run.begun_at);
    each_field(result, [&](const RecordField& field, const auto& value) {
      const bool is_missing = std::string_view(field.name) == "grade" && !is_graded(result);
      is_missing ? void(table.text("")) : add_field(table, field, value);
    });
    table.number(points_lost(result)).number(result.shifts.size()).number(result.errors.size());
    table.text(run.recording.empty() ? run.kept_at : run.recording).text(comments_text(run.comments)).end();
  }
  return std::move(table).take();
}

std::string shifts_csv(const LearnerHistory& history, const base::CsvFormat& format) {
  base::CsvTable table(format);
  table.text("run");
  add_names<ShiftRecord>(table);
  table.end();
  for (const RunRow& run : history.runs) {
    for (const ShiftRecord& shift : run.result.shifts) {
      table.number(run.id);
      add_fields(table, shift);
      table.end();
    }
  }
  return std::move(table).take();
}

std::string errors_csv(const LearnerHistory& history, const base::CsvFormat& format) {
  base::CsvTable table(format);
  table.texts({"run", "error"});
  add_names<DrivingError>(table);
  table.end();
  for (const RunRow& run : history.runs) {
    const LessonResult& result = run.result;
    for (std::size_t i = 0; i < result.errors.size(); ++i) {
      table.number(run.id).number(i + 1);
      add_fields(table, result.errors[i]);
      table.end();
    }
  }
  return std::move(table).take();
}

std::string standings_csv(std::span<const LearnerHistory> learners, std::span<const Lesson> lessons,
                          const base::CsvFormat& format) {
  base::CsvTable table(format);
  table.texts({"learner", "task", "standing", "why", "next"}).end();
  for (const LearnerHistory& history : learners) {
    for (const TaskStanding& task : task_standings(history, lessons))
      table.texts({history.learner.name, task.task, to_string(task.standing), task.sentence, task.advice}).end();
  }
  return std::move(table).take();
}

}  // namespace gearshift::lessons
