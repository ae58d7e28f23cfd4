// Invalid numbers in the history (NaN, infinity, out of range), which a bug or a different program may have written.
#include <sqlite3.h>

#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "app/lessons/history/history.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void write_by_hand(const std::filesystem::path& file, const std::string& text) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(file.c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
}

void check_can_be(double value) {
  CHECK(std::isfinite(value));
  CHECK(std::abs(value) <= 1e9);  // so that it fits into an int
}

void check_can_be(const LessonResult& result) {
  for (const double value : {result.begin, result.duration, result.slip_energy, result.fuel}) check_can_be(value);
  CHECK(result.grade >= 0.0);
  CHECK(result.grade <= 10.0);
  CHECK(result.mode <= LessonMode::by_yourself);
  CHECK(result.end <= LessonEnd::left);
  for (const ShiftRecord& shift : result.shifts) {
    CHECK(std::string(gear_name(shift.from)) != "?");
    CHECK(std::string(gear_name(shift.to)) != "?");
    CHECK(shift.number >= 0);
    CHECK(shift.number < 1'000'000);
    each_figure(shift, [](const char*, const auto& value) { check_can_be(static_cast<double>(value)); });
  }
  for (const DrivingError& error : result.errors) {
    CHECK(error.severity <= Severity::very_severe);
    check_can_be(error.value);
    check_can_be(error.wanted);
    check_can_be(error.time);
    CHECK(error.shift >= -1);
    CHECK(error.shift < 1'000'000);
    CHECK(!error_sentence(error).empty());
  }
  for (const Deduction& deduction : result.deductions) {
    CHECK(deduction.error < result.errors.size());
    CHECK(deduction.points <= 10.0);
  }
}

}  // namespace

TEST_CASE("a non-finite value is dropped, the shift and the run are kept, and no sentence is wrong because of it") {
  const TempFolder folder;
  History history(folder / "history.db");
  const std::int64_t ada = history.find_or_add_learner("Ada");
  const std::int64_t run = history.begin_run(history.begin_session(ada, "1.0"), some_result(0), "");
  LessonResult result = some_result(1);
  result.shifts[0].path_efficiency = kNan;
  result.shifts[0].jerk_peak = kInfinity;
  result.errors[0].value = kNan;
  result.duration = kNan;
  history.add_shift(run, result.shifts[0]);
  history.end_run(run, result);
  const std::vector<RunRow> runs = history.runs(ada);
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].result.end == LessonEnd::done);
  CHECK(runs[0].result.grade == result.grade);
  REQUIRE(runs[0].result.shifts.size() == 1);
  CHECK(runs[0].result.shifts[0].path_efficiency == 0.0);
  CHECK(runs[0].result.shifts[0].lever_time == result.shifts[0].lever_time);
  CHECK(runs[0].result.errors.size() == result.errors.size());
  check_can_be(runs[0].result);
}

TEST_CASE("impossible values in the file are read as possible ones, or not at all") {
  for (const char* value :
       {"9e999", "-9e999", "1e300", "-1e300", "'text'", "x'ff'", "-4294967297", "9223372036854775807"}) {
    CAPTURE(value);
    const TempFolder folder;
    const auto file = folder / "history.db";
    std::int64_t ada = 0;
    {
      History history(file);
      ada = history.find_or_add_learner("Ada");
      const std::int64_t run = history.begin_run(history.begin_session(ada, "1.0"), some_result(0), "");
      history.end_run(run, some_result(3));
    }
    const ShiftRecord none;
    std::string text;
    for (const char* field : {"mode", "ended", "guided", "complete", "begin_s", "duration_s", "grade", "passed",
                              "slip_energy_j", "engine_work_j"})
      text += std::string("UPDATE lesson_run SET ") + field + " = " + value + ";";
    each_figure(none, [&](const char* name, const auto&) {
      text += std::string("UPDATE shift SET ") + name + " = " + value + " WHERE number > 0;";
    });
    text += std::string("UPDATE shift SET from_gear = ") + value + " WHERE number = 2;";
    text += std::string("UPDATE shift SET number = ") + value + " WHERE number = 1;";
    for (const char* field : {"severity", "time_s", "value", "shift", "points", "wanted"})
      text += std::string("UPDATE driving_error SET ") + field + " = " + value + ";";
    text += "UPDATE driving_error SET kind = 'missed_shift' WHERE number = 1;";
    write_by_hand(file, text);
    History history(file);
    const std::vector<RunRow> runs = history.runs(ada);
    REQUIRE(runs.size() == 1);
    CHECK(runs[0].result.shifts.size() >= 1);
    check_can_be(runs[0].result);
  }
}
