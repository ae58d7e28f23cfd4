#include "haptics/loop/trace_csv.h"

#include <algorithm>
#include <clocale>
#include <limits>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "tests/haptics/loop/trace_bench.h"

namespace gearshift::test {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) out.push_back(cell);
  return out;
}

std::map<std::string, std::string> by_name(const std::string& line) {
  const std::vector<std::string> names = cells(haptics::trace_csv_header()), values = cells(line);
  REQUIRE(names.size() == values.size());
  std::map<std::string, std::string> row;
  for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = values[i];
  REQUIRE(row.size() == names.size());  // no column name occurs twice
  return row;
}

haptics::TraceSample known_sample() {
  haptics::TraceSample sample;
  sample.deadline_ns = 5'000'000'000;
  sample.out.cycle = 42;
  sample.out.lever = {-0.0125, 0.03};
  sample.out.velocity = {0.25, 0.0};
  sample.out.commanded = {1.5, -31.7};
  sample.out.wall_stiffness = 4321.5;
  sample.out.gear = haptics::kReverseGear;
  sample.out.guard = haptics::GuardState::running;
  sample.out.flags = haptics::kFlagContact | haptics::kFlagFresh;
  sample.controls.pedals.clutch = 0.75;
  sample.controls.slope = -0.0625;
  sample.controls.guided_gear = 3;
  sample.controls.guidance = 0.5;
  sample.command = haptics::LoopCommand::stop;
  sample.reading.stop = true;
  sample.reading.time_ns = 4'998'000'000;
  sample.reading.hand_force = {std::numeric_limits<double>::quiet_NaN(), 2.0};
  return sample;
}

// A locale that writes numbers as 1.234,5. The CSV must not use this locale.
struct GermanNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("csv: the header begins with the time in seconds and every quantity carries its unit") {
  CHECK(haptics::trace_csv_header().find(
            "time_s,cycle,lever_x_mm,lever_y_mm,velocity_x_mm_per_s,velocity_y_mm_per_s,proxy_x_mm,") == 0);
  const std::set<std::string> plain{"cycle",
                                    "gear",
                                    "slot",
                                    "guard",
                                    "fault",
                                    "contact",
                                    "saturated",
                                    "over_push",
                                    "push_estimated",
                                    "ghost",
                                    "fresh",
                                    "skipped_cycles",
                                    "reading_sequence",
                                    "reading_pressed_down",
                                    "reading_lifted",
                                    "reading_stop",
                                    "throttle",
                                    "brake",
                                    "clutch",
                                    "hand_brake",
                                    "ignition",
                                    "starter",
                                    "guided_gear",
                                    "guidance",
                                    "command",
                                    "tuning_feel_scale"};
  for (const std::string& name : cells(haptics::trace_csv_header())) {
    CAPTURE(name);
    bool has_unit = false;
    for (const std::string unit : {"_s", "_mm", "_n", "_rad", "_per_m", "_per_s"}) has_unit |= name.ends_with(unit);
    CHECK(has_unit != plain.contains(name));
  }
}

TEST_CASE("csv: numbers are in the unit of their column") {
  auto row = by_name(haptics::trace_csv_line(known_sample(), 4'999'000'000));
  CHECK(row["cycle"] == "42");
  CHECK(row["time_s"] == "0.001");
  CHECK(row["lever_x_mm"] == "-12.5");
  CHECK(row["lever_y_mm"] == "30");
  CHECK(row["velocity_x_mm_per_s"] == "250");
  CHECK(row["commanded_y_n"] == "-31.7");
  CHECK(row["gear"] == "-1");
  CHECK(row["guard"] == "running");
  CHECK(row["contact"] == "1");
  CHECK(row["ghost"] == "0");
  CHECK(row["clutch"] == "0.75");
  CHECK(row["slope_rad"] == "-0.0625");
  CHECK(row["guided_gear"] == "3");
  CHECK(row["guidance"] == "0.5");
  CHECK(row["command"] == "stop");
  CHECK(row["reading_stop"] == "1");
  CHECK(row["reading_time_s"] == "-0.001");
  CHECK(row["wall_stiffness_n_per_m"] == "4321.5");
  CHECK(row["tuning_wall_stiffness_n_per_m"] == "5000");
  CHECK(row["reading_hand_force_x_n"] == "nan");
}

TEST_CASE("csv: the same in any locale") {
  const TempFolder folder;
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new GermanNumbers));
  haptics::TraceSample later = known_sample();
  later.out.cycle = 1'234'567;
  {
    haptics::TraceCsvFile csv(folder / "t.csv");
    csv.add(known_sample());
    csv.add(later);
    csv.finish();
  }
  std::locale::global(before);
  std::ifstream stream(folder / "t.csv");
  std::string line;
  std::getline(stream, line);
  CHECK(line == haptics::trace_csv_header());
  std::getline(stream, line);
  CHECK(by_name(line)["lever_x_mm"] == "-12.5");
  CHECK(by_name(line)["time_s"] == "0");  // time starts at the file's first sample
  std::getline(stream, line);
  CHECK(by_name(line)["cycle"] == "1234567");
  CHECK_FALSE(std::getline(stream, line));
}

TEST_CASE("csv: an unfinished file does not replace an existing one") {
  const TempFolder folder;
  std::ofstream(folder / "t.csv") << "of old";
  haptics::TraceCsvFile(folder / "t.csv").add(known_sample());
  std::string line;
  std::getline(std::ifstream(folder / "t.csv"), line);
  CHECK(line == "of old");
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("csv: a file that cannot be written is reported in one sentence") {
  const TempFolder folder;
  CHECK_THROWS_WITH_AS(haptics::TraceCsvFile(folder / "no/folder.csv"), doctest::Contains("cannot be written"),
                       haptics::FileError);
  haptics::TraceCsvFile csv("/dev/full");
  for (int i = 0; i < 1000; ++i) csv.add(known_sample());
  CHECK_THROWS_WITH_AS(csv.finish(), doctest::Contains("could not be written"), haptics::FileError);
}

}  // namespace gearshift::test
