// Tests that an independent parser finds the written data in the tables.
#include "app/lessons/report/report_csv.h"

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <doctest/doctest.h>

#include "app/lessons/report/progress.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/app/lessons/report/constructed_history.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

// A strict parser of RFC 4180, section 2: records end with CRLF and have equally many fields, and quotes are only in
// quoted fields.
std::vector<std::vector<std::string>> parse(const std::string& text) {
  std::vector<std::vector<std::string>> records(1);
  std::size_t at = 0;
  while (at < text.size()) {
    std::string field;
    if (text[at] == '"') {
      for (++at;; ++at) {
        if (at >= text.size()) throw std::runtime_error("a quote is open");
        if (text[at] != '"')
          field += text[at];
        else if (at + 1 < text.size() && text[at + 1] == '"')
          field += text[++at];
        else
          break;
      }
      ++at;
    } else {
      for (; at < text.size() && text[at] != ',' && text[at] != '\r'; ++at) {
        if (text[at] == '"' || text[at] == '\n') throw std::runtime_error("not quoted");
        field += text[at];
      }
    }
    records.back().push_back(field);
    if (text[at] == ',') {
      ++at;
    } else {
      if (text.substr(at, 2) != "\r\n") throw std::runtime_error("no CRLF");
      at += 2;
      if (at < text.size()) records.emplace_back();
    }
  }
  for (const auto& record : records)
    if (record.size() != records.front().size()) throw std::runtime_error("another number of fields");
  return records;
}

// Record number `i` as a map from column names to fields.
std::map<std::string, std::string> row(const std::vector<std::vector<std::string>>& records, std::size_t i) {
  std::map<std::string, std::string> fields;
  for (std::size_t c = 0; c < records[0].size(); ++c) fields[records[0][c]] = records[i + 1][c];
  REQUIRE(fields.size() == records[0].size());
  return fields;
}

const std::string kNasty = "a,\"b\"\r\n'c';\t=1+1\n\"";
const std::string kPrintable = "a,\"b\" \n'c'; =1+1\n\"";  // carriage return and tab are spaces in a table

LearnerHistory history_with_everything() {
  LearnerHistory history;
  history.learner.name = kNasty;
  RunRow run;
  run = {12, 3, "2026-01-02T03:04:05Z", "a \"trace\".trace", some_result(5)};
  run.comments = {{"2026-01-03T00:00:00Z", "Bo", kNasty}, {"2026-01-04T00:00:00Z", "Di", "Fine."}};
  history.runs.push_back(run);
  history.runs.push_back(run_with(13, 0, 5.5));
  history.runs[1].result.guided = true;
  return history;
}

// Whether `field` equals `value` within half a unit of the twelfth significant digit.
bool is_read_back(const std::string& field, double value) {
  return std::abs(std::stod(field) - value) <= 5e-12 * std::abs(value);
}

}  // namespace

TEST_CASE("runs are read back from the table") {
  const auto records = parse(runs_csv(history_with_everything(), {}));
  REQUIRE(records.size() == 3);
  auto fields = row(records, 0);
  CHECK(fields["run"] == "12");
  CHECK(fields["session"] == "3");
  CHECK(fields["learner"] == kPrintable);
  CHECK(fields["begun_at_utc"] == "2026-01-02T03:04:05Z");
  CHECK(fields["lesson"] == "hill_start");
  CHECK(fields["task"] == "moving_off");
  CHECK(fields["mode"] == "by_yourself");
  CHECK(fields["ended"] == "done");
  CHECK(fields["guided"] == "0");
  CHECK(fields["complete"] == "1");
  CHECK(fields["begin_s"] == "12.5");
  CHECK(fields["duration_s"] == "34.25");
  CHECK(fields["grade"] == "7.5");
  CHECK(fields["points_off"] == "2.5");
  CHECK(fields["passed"] == "1");
  CHECK(fields["why"] == some_result(0).why);
  CHECK(fields["slip_energy_j"] == "2020.5");
  CHECK(fields["shifts"] == "5");
  CHECK(fields["errors"] == "4");
  CHECK(fields["recording"] == "a \"trace\".trace");
  CHECK(fields["comments"] == "Bo, 2026-01-03T00:00:00Z: " + kPrintable + "\nDi, 2026-01-04T00:00:00Z: Fine.");
  CHECK(row(records, 1)["grade"].empty());  // the run was guided, so its grade is empty and not zero
}

TEST_CASE("rounding errors in a time's last bit are not printed, and a small time keeps its digits") {
  LearnerHistory history = history_with_everything();
  LessonResult& result = history.runs[0].result;
  result.begin = std::nextafter(13.379, 14.0);  // 13.379000000000001
  result.duration = 1.0 / 3.0;
  result.slip_energy = -0.0;
  result.shifts[0].path_length = 1.25e-7;
  result.shifts[0].impulse = 123456789.125;
  const auto runs = parse(runs_csv(history, {}));
  auto fields = row(runs, 0);
  CHECK(fields["begin_s"] == "13.379");
  CHECK(fields["duration_s"] == "0.333333333333");
  CHECK(fields["slip_energy_j"] == "0");
  const auto shifts = parse(shifts_csv(history, {}));
  CHECK(std::stod(row(shifts, 0)["path_length_m"]) == 1.25e-7);
  CHECK(row(shifts, 0)["impulse_n_s"] == "123456789.125");
}

TEST_CASE("shifts are read back from the table, every number to twelve digits") {
  LearnerHistory history = history_with_everything();
  history.runs[0].result.shifts[2].jerk_peak = std::nextafter(0.1, 1.0);
  const auto records = parse(shifts_csv(history, {}));
  REQUIRE(records.size() == 6);
  for (std::size_t i = 0; i < 5; ++i) {
    auto fields = row(records, i);
    const ShiftRecord& shift = history.runs[0].result.shifts[i];
    CHECK(fields["run"] == "12");
    CHECK(fields["shift"] == std::to_string(i + 1));  // counted from 1
    CHECK(fields["from_gear"] == gear_name(shift.from));
    CHECK(fields["to_gear"] == gear_name(shift.to));
    CHECK(fields["guided"] == (shift.guided ? "1" : "0"));
    CHECK(fields["missed"] == (shift.missed ? "1" : "0"));
    CHECK(fields["steps"] == "clutch_down throttle_off gear clutch_up");
    each_field(shift, [&](const RecordField& field, const auto& value) {
      CAPTURE(field.name);
      if constexpr (std::is_same_v<decltype(value), const double&>) CHECK(is_read_back(fields.at(field.name), value));
    });
    CHECK(fields["steps_out_of_place"] == std::to_string(shift.steps_out_of_place));
  }
}

TEST_CASE("errors are read back from the table, with points and only the values that their kind has") {
  const auto records = parse(errors_csv(history_with_everything(), {}));
  REQUIRE(records.size() == 5);
  auto stall = row(records, 0), rollback = row(records, 1), jerk = row(records, 2), slow = row(records, 3);
  CHECK(stall["kind"] == "stall");
  CHECK(stall["severity"] == "severe");
  CHECK(stall["time_s"] == "13.5");
  CHECK(stall["engine_speed_rad_per_s"] == "36.6");
  CHECK(stall["jerk_m_per_s3"].empty());
  CHECK(stall["shift"].empty());
  CHECK(stall["points"] == "2");
  CHECK(rollback["distance_m"] == "0.3");
  CHECK(rollback["shift"] == "1");
  CHECK(rollback["error"] == "2");
  CHECK(rollback["points"] == "0.5");
  CHECK(jerk["jerk_m_per_s3"] == "9");
  CHECK(jerk["points"] == "0");
  CHECK(jerk["step"].empty());
  CHECK(jerk["time_limit_s"].empty());
  CHECK(slow["duration_s"] == "4");
  CHECK(slow["step"] == "Let the \"hand\" brake off.");
  CHECK(slow["time_limit_s"] == "2.5");
}

TEST_CASE("every kind of error has one measured value, in a column with the right unit") {
  LearnerHistory history;
  history.runs.push_back(run_with(1, 1, 5.0));
  for (int i = 0; i < kErrorKindCount; ++i)
    history.runs[0].result.errors.push_back(make_driving_error(static_cast<ErrorKind>(i), Severity::minor, 1, 3.0));
  const auto records = parse(errors_csv(history, {}));
  REQUIRE(records.size() == kErrorKindCount + 1);
  std::map<std::string, std::string> measured;  // kind of error to column
  for (std::size_t i = 0; i < kErrorKindCount; ++i) {
    auto fields = row(records, i);
    for (const auto& [name, value] : fields) {
      if (value == "3" && name != "error") measured[fields["kind"]] += name;
    }
  }
  const std::map<std::string, std::string> expected{{"clutch_dump", "slip_power_w"},
                                                    {"throttle_in_shift", "rev_rise_rad_per_s"},
                                                    {"grind", "heat_j"},
                                                    {"missed_shift", "gear"},
                                                    {"over_push", "force_n"},
                                                    {"rollback", "distance_m"},
                                                    {"wrong_direction", "road_speed_m_per_s"},
                                                    {"coasting", "duration_s"},
                                                    {"early_downshift", "engine_speed_rad_per_s"}};
  CHECK(measured.size() == kErrorKindCount);
  for (const auto& [kind, column] : expected) CHECK(measured[kind] == column);
}

// The format in which a spreadsheet of a locale with decimal commas reads every number as a number.
TEST_CASE("with a semicolon and decimal commas the same records are read back, behind a byte order mark") {
  const gearshift::base::CsvFormat format{';', true, true};
  const std::string text = runs_csv(history_with_everything(), format), mark = "\xef\xbb\xbf";
  REQUIRE(text.starts_with(mark + "run;session;learner;"));
  CHECK(text.find(";12,5;34,25;7,5;") != std::string::npos);  // begin, duration, grade
  CHECK(text.find("2020,5") != std::string::npos);
  CHECK(text.find("\"It's \"\"why\"\"; DROP TABLE shift; --\"") != std::string::npos);
}

TEST_CASE("the class table has a line per learner and task") {
  std::vector<LearnerHistory> learners(2);
  learners[0].learner.name = "Ada";
  learners[0].runs.push_back(run_with(1, 1, 9.0));
  learners[1].learner.name = "Bo, \"the\" second";
  std::vector<Lesson> lessons(1);
  lessons[0].key = "drill";
  lessons[0].task = "upshift";
  const auto records = parse(standings_csv(learners, lessons, {}));
  REQUIRE(records.size() == 3);
  CHECK(records[1] == std::vector<std::string>{"Ada", "upshift", "nearly",
                                               "Passed once, but not yet again on another day or after another lesson.",
                                               "Drive it again on another day."});
  CHECK(records[2] == std::vector<std::string>{"Bo, \"the\" second", "upshift", "not tried", "", ""});
}

TEST_CASE("without runs a table has only its header") {
  for (const std::string& text : {runs_csv({}, {}), shifts_csv({}, {}), errors_csv({}, {})})
    CHECK(parse(text).size() == 1);
}

TEST_CASE("500 runs make 500 records") {
  LearnerHistory history;
  for (int i = 0; i < 500; ++i) history.runs.push_back(run_with(i + 1, 8, 7.0));
  CHECK(parse(runs_csv(history, {})).size() == 501);
  CHECK(parse(shifts_csv(history, {})).size() == 4001);
}
