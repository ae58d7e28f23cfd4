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

void check_numbers(const auto& record) {
  each_field(record, [](const RecordField&, const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::optional<double>>) check_can_be(value.value_or(0.0));
    if constexpr (std::is_arithmetic_v<Value>) check_can_be(static_cast<double>(value));
  });
}

void check_can_be(const LessonResult& result) {
  check_numbers(result);
  CHECK(result.grade >= 0.0);
  CHECK(result.grade <= 10.0);
  CHECK(result.mode <= LessonMode::by_yourself);
  CHECK(result.end <= LessonEnd::left);
  for (const ShiftRecord& shift : result.shifts) {
    CHECK(std::string(gear_name(shift.from)) != "?");
    CHECK(std::string(gear_name(shift.to)) != "?");
    CHECK(shift.number >= 0);
    CHECK(shift.number < 1'000'000);
    check_numbers(shift);
  }
  for (const DrivingError& error : result.errors) {
    CHECK(error.severity <= Severity::very_severe);
    CHECK(error.points >= 0.0);
    CHECK(error.points <= 10.0);
    check_numbers(error);
    CHECK(std::string(gear_name(error.gear.value_or(0))) != "?");
    CHECK(error.shift >= -1);
    CHECK(error.shift < 1'000'000);
    CHECK(!error_sentence(error).empty());
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
  result.errors[0].engine_speed = kNan;
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
    const std::int64_t ada = write_one_run(file, 3);
    std::string text;
    const auto spoil = [&](const std::string& table, const std::string& field, const std::string& where) {
      text.append("UPDATE ")
          .append(table)
          .append(" SET ")
          .append(field)
          .append(" = ")
          .append(value)
          .append(where)
          .append(";");
    };
    each_field(LessonResult(), [&](const RecordField& field, const auto&) { spoil("lesson_run", field.name, ""); });
    each_field(ShiftRecord(), [&](const RecordField& field, const auto&) {
      if (!field.is_gear && std::string(field.name) != "shift") spoil("shift", field.name, " WHERE shift > 0");
    });
    spoil("shift", "from_gear", " WHERE shift = 2");
    spoil("shift", "shift", " WHERE shift = 1");
    each_field(DrivingError(), [&](const RecordField& field, const auto&) {
      spoil("driving_error", field.name, std::string(field.name) == "kind" ? " WHERE number = 0" : "");
    });
    spoil("driving_error", "points", "");
    text += "UPDATE driving_error SET kind = 'missed_shift' WHERE number = 1;";
    write_by_hand(file, text);
    History history(file);
    const std::vector<RunRow> runs = history.runs(ada);
    REQUIRE(runs.size() == 1);
    CHECK(runs[0].result.shifts.size() >= 1);
    check_can_be(runs[0].result);
  }
}
