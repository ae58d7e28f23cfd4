#include "app/lessons/report/report_json.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/report/progress.h"
#include "app/lessons/report/standing.h"

namespace gearshift::lessons {
namespace {

using Json = nlohmann::ordered_json;

void add_value(Json& json, const RecordField& field, const auto& value) {
  using Value = std::remove_cvref_t<decltype(value)>;
  if constexpr (std::is_same_v<Value, std::vector<ShiftStep>>) {
    json[field.name] = format_steps(value);
  } else if constexpr (std::is_enum_v<Value>) {
    if (const std::string_view text = to_string(value); !text.empty()) json[field.name] = text;
  } else if constexpr (std::is_same_v<Value, std::int64_t>) {
    if (value >= 0) json[field.name] = value + 1;
  } else if constexpr (std::is_same_v<Value, int>) {
    field.is_gear ? json[field.name] = haptics::gear_name(value) : json[field.name] = value;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    if (!value.empty()) json[field.name] = value;
  } else if constexpr (requires { value.has_value(); }) {
    if (value) add_value(json, field, *value);
  } else {
    json[field.name] = value;
  }
}

Json record_json(const auto& record) {
  Json json = Json::object();
  each_field(record, [&](const RecordField& field, const auto& value) { add_value(json, field, value); });
  return json;
}

Json figure_json(const FigureLine& line) {
  Json json{{"name", line.figure->name}, {"label", line.label}, {"value", line.measured}};
  if (!line.typical) return json;
  json["norm"] = {{"typical", *line.typical}, {"up_to", *line.upper}};
  json["is_worse"] = line.is_worse;
  return json;
}

Json comment_json(const CommentRow& comment) {
  Json json{{"comment", comment.id}, {"author", comment.author}, {"at", comment.at}, {"text", comment.text}};
  if (!comment.edited_at.empty()) json["edited_at"] = comment.edited_at;
  return json;
}

const Norm* norm_in(const LessonResult& result, std::span<const Lesson> lessons) {
  const auto lesson =
      std::find_if(lessons.begin(), lessons.end(), [&](const Lesson& l) { return l.key == result.lesson; });
  return result.score && lesson != lessons.end() ? norm_of(*lesson, result.mode) : nullptr;
}

Json run_json(const RunRow& run, std::span<const Lesson> lessons) {
  Json json{{"run", run.id}, {"session", run.session}, {"begun_at_utc", run.begun_at}, {"recording", run.recording}};
  json.update(result_json(run.result, norm_in(run.result, lessons)));
  json["comments"] = Json::array();
  for (const CommentRow& comment : run.comments) json["comments"].push_back(comment_json(comment));
  return json;
}

}  // namespace

Json shift_json(const ShiftRecord& shift) {
  return record_json(shift);
}

Json error_json(const DrivingError& error) {
  Json json = record_json(error);
  if (const std::optional<MeasuredValue> measured = measured_value(error)) {
    json["value"] = measured->value;
    json["unit"] = measured->unit;
  }
  json["sentence"] = error_sentence(error);
  return json;
}

Json result_json(const LessonResult& result, const Norm* norm) {
  Json json = record_json(result);
  if (!is_graded(result)) json.erase("grade");
  json["verdict"] = result.passed ? "passed" : is_graded(result) ? "not passed" : "not graded";
  json["figures"] = json["errors"] = json["shifts"] = Json::array();
  for (const FigureLine& line : figure_lines(result, norm)) json["figures"].push_back(figure_json(line));
  if (norm != nullptr) json["norm_origin"] = kNormOrigin;
  for (const DrivingError& error : result.errors) json["errors"].push_back(error_json(error));
  for (const ShiftRecord& shift : result.shifts) json["shifts"].push_back(shift_json(shift));
  return json;
}

Json standing_json(const LearnerHistory& history, std::span<const Lesson> lessons) {
  const Totals sum = totals(history);
  const NextLesson next = next_lesson(history, lessons);
  Json json{{"learner", history.learner.name},
            {"sessions", sum.sessions},
            {"runs", sum.runs},
            {"last_day", sum.last_day},
            {"next", {{"lesson", next.lesson}, {"why", next.why}, {"by_instructor", next.by_instructor}}}};
  json["tasks"] = Json::array();
  for (const TaskStanding& task : task_standings(history, lessons))
    json["tasks"].push_back(
        {{"task", task.task}, {"standing", to_string(task.standing)}, {"why", task.sentence}, {"next", task.advice}});
  return json;
}

Json history_json(const LearnerHistory& history, std::span<const Lesson> lessons) {
  Json json = standing_json(history, lessons);
  json["runs"] = Json::array();
  for (const RunRow& run : history.runs) json["runs"].push_back(run_json(run, lessons));
  return json;
}

}  // namespace gearshift::lessons
