// Tests that a parser finds every field of a run in the JSON, with the units of its name, and the sentence's figures.
#include "app/lessons/report/report_json.h"

#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/app/lessons/history/sample_result.h"
#include "tests/app/lessons/report/constructed_history.h"

using namespace gearshift::lessons;
using namespace gearshift::test;
using nlohmann::json;

namespace {

json parsed(const nlohmann::ordered_json& document) {
  return json::parse(document.dump());
}

}  // namespace

TEST_CASE("a run's fields are in the JSON under the names of the CSV columns") {
  const LessonResult result = some_result(5);
  const json run = parsed(result_json(result, nullptr));
  CHECK(run["lesson"] == result.lesson);
  CHECK(run["duration_s"] == result.duration);
  CHECK(run["jerk_peak_m_per_s3"] == *result.figures.jerk_peak);
  CHECK(run["shifts"].size() == result.shifts.size());
  CHECK(run["errors"].size() == result.errors.size());
  CHECK(run["shifts"][0]["shift"] == 1);
  CHECK(run["shifts"][0]["to_gear"] == gearshift::haptics::gear_name(result.shifts[0].to));
}

TEST_CASE("the verdict is passed, not passed or not graded, and only a graded run has a grade") {
  RunRow run = run_with(1, 0, 7.5);
  CHECK(parsed(result_json(run.result, nullptr))["verdict"] == "passed");
  CHECK(parsed(result_json(run.result, nullptr))["grade"] == 7.5);
  run = run_with(1, 0, 3.0);
  CHECK(parsed(result_json(run.result, nullptr))["verdict"] == "not passed");
  run.result.guided = true;
  const json guided = parsed(result_json(run.result, nullptr));
  CHECK(guided["verdict"] == "not graded");
  CHECK_FALSE(guided.contains("grade"));
}

TEST_CASE("an error's value and unit are those of its sentence") {
  // 2 pi / 60 rad/s is 1 rpm; kilowatts and kilojoules are thousands of the stored units.
  const DrivingError stall =
      make_driving_error(ErrorKind::stall, Severity::severe, 1.5, 100.0 * 2.0 * 3.14159265358979 / 60.0);
  CHECK(error_json(stall)["value"].get<double>() == doctest::Approx(100.0));
  CHECK(error_json(stall)["unit"] == "rpm");
  const DrivingError dump = make_driving_error(ErrorKind::clutch_dump, Severity::severe, 1.5, 20e3);
  CHECK(error_json(dump)["value"] == 20.0);
  CHECK(error_json(dump)["unit"] == "kW");
  CHECK_FALSE(error_json(make_driving_error(ErrorKind::missed_shift, Severity::minor, 1.5, 3)).contains("value"));
  for (int i = 0; i < kErrorKindCount; ++i) {
    const auto kind = static_cast<ErrorKind>(i);
    const json error = parsed(error_json(make_driving_error(kind, Severity::minor, 2.0, 3.0)));
    CHECK(error["kind"] == to_string(kind));
    CHECK(error["time_s"] == 2.0);
    CHECK(error["sentence"] == error_sentence(make_driving_error(kind, Severity::minor, 2.0, 3.0)));
    // In the sentence the value is followed by its unit (rpm, s, kW, km/h, m/s³, ...), which the table names once more.
    const std::string unit = error.value("unit", "");
    if (!unit.empty() && unit != "m/s^3")
      CHECK_MESSAGE(error["sentence"].get<std::string>().find(" " + unit) != std::string::npos, to_string(kind));
  }
}

TEST_CASE("each figure has its norm") {
  Norm norm;
  norm.figures[1] = FigureNorm{20.0, 2.0};  // the largest jerk
  LessonResult result;
  result.figures.jerk_peak = 90.0;
  result.slip_energy = 500.0;
  const json figures = parsed(result_json(result, &norm))["figures"];
  REQUIRE(figures.size() == 2);
  CHECK_FALSE(figures[0].contains("norm"));
  CHECK(figures[1]["name"] == "jerk_peak_m_per_s3");
  CHECK(figures[1]["value"] == 90.0);
  CHECK(figures[1]["norm"]["typical"] == 20.0);
  // 95 % of a normal distribution lie below 1.645 standard deviations; 20 times 2 to that power is 62.5.
  CHECK(figures[1]["norm"]["up_to"].get<double>() == doctest::Approx(62.55).epsilon(0.001));
  CHECK(figures[1]["is_worse"] == true);
}

TEST_CASE("a learner's JSON has the standing of every task, the next lesson and all runs, oldest first") {
  LearnerHistory history;
  history.learner.name = "Zoë \"Z\"\n";
  history.runs = {run_with(1, 1, 3.0), run_with(2, 0, 8.0)};
  history.runs[1].comments = {{"2026-01-03T00:00:00Z", "Bo", "Fine."}};
  Lesson first;
  first.key = first.task = "start_and_stop";
  const json document = parsed(history_json(history, std::vector{first}));
  CHECK(document["learner"] == history.learner.name);
  CHECK(document["next"]["lesson"] == "start_and_stop");
  CHECK(document["runs"].size() == 2);
  CHECK(document["runs"][0]["run"] == 1);
  CHECK(document["runs"][1]["comments"][0]["text"] == "Fine.");
  std::set<std::string> tasks;
  for (const json& task : document["tasks"]) tasks.insert(task["task"]);
  CHECK(tasks == std::set<std::string>{"start_and_stop", "upshift"});
}
