// Tests that the timeline's bars have the lengths and positions that the shift's times require.
#include "app/lessons/report/timeline_svg.h"

#include <doctest/doctest.h>

#include "tests/app/lessons/report/constructed_history.h"
#include "tests/app/lessons/report/page_parts.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

constexpr const char* kClutch = "#8d99a6";
constexpr const char* kLever = "#1f5fa8";
constexpr const char* kRed = "#c5303b";

struct Bar {
  double x = 0.0, width = 0.0;
};

// The bars of this colour, without the bar in the legend.
std::vector<Bar> bars_of(const std::string& svg, const std::string& colour) {
  std::vector<Bar> bars;
  for (std::size_t at = 0;;) {
    const std::string_view rect = between(svg, "<rect ", "/>", at);
    if (at == std::string::npos) break;
    if (rect.find(colour) == std::string_view::npos) continue;
    bars.push_back(
        {std::stod(std::string(between(rect, "x=\"", "\""))), std::stod(std::string(between(rect, "width=\"", "\"")))});
  }
  bars.erase(bars.begin());
  return bars;
}

ShownShift chosen(const ShiftRecord& shift) {
  return {{7, "drill", "", shift, {}, 0.0}, {}, {}};
}

}  // namespace

TEST_CASE("clutch and lever share one axis: the clutch is down for 0.5 s, the lever moves from 0.10 to 0.35 s") {
  const std::vector<ShownShift> shifts{chosen(good_shift(2, 40.0))};
  const std::string svg = timeline_svg(shifts);
  const auto clutch = bars_of(svg, kClutch), lever = bars_of(svg, kLever);
  REQUIRE(clutch.size() == 1);
  REQUIRE(lever.size() == 1);
  const double second = clutch[0].width / 0.5;
  CHECK(lever[0].width / second == doctest::Approx(0.25).epsilon(1e-4));
  CHECK((lever[0].x - clutch[0].x) / second == doctest::Approx(0.10).epsilon(1e-4));
  CHECK(bars_of(svg, kRed).empty());
  for (const char* words : {"0.50 s clutch", "0.25 s lever", "run 7, shift 3", "2 → 3"})
    CHECK(svg.find(words) != std::string::npos);
}

TEST_CASE("lever movement without the clutch is red, before the clutch was down and after it came up") {
  ShiftRecord early = good_shift(0, 40.0), late = good_shift(0, 40.0);
  early.clutch_lag = -0.05;
  late.clutch_lead = -0.08;
  const std::vector<ShownShift> shifts{chosen(early), chosen(late)};
  const std::string svg = timeline_svg(shifts);
  const auto lever = bars_of(svg, kLever), red = bars_of(svg, kRed);
  REQUIRE(lever.size() == 2);
  REQUIRE(red.size() == 2);
  const double second = lever[0].width / 0.25;
  CHECK(red[0].width / second == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(red[0].x + red[0].width == doctest::Approx(lever[0].x + lever[0].width).epsilon(1e-5));
  CHECK(red[1].width / second == doctest::Approx(0.08).epsilon(1e-3));
  CHECK(red[1].x == doctest::Approx(lever[1].x).epsilon(1e-5));
}

TEST_CASE("a minute with the clutch down does not compress the other bars: the axis ends at 8 s") {
  ShiftRecord waits = good_shift(0, 40.0);
  waits.clutch_lead = 60.0;
  waits.clutch_time = 60.4;
  waits.end = waits.begin + 60.5;
  const std::vector<ShownShift> shifts{chosen(waits), chosen(good_shift(1, 40.0))};
  const auto clutch = bars_of(timeline_svg(shifts), kClutch);
  REQUIRE(clutch.size() == 2);
  CHECK(clutch[0].width / clutch[1].width == doctest::Approx(8.0 / 0.5).epsilon(1e-3));
}

// The lever moves from 0.10 s to 0.45 s. The pedal is down from 0 to 0.2 s and from 0.3 to 0.4 s.
TEST_CASE(
    "a clutch pressed twice is drawn as recorded, with red between the presses; without a recording nothing is red") {
  ShiftRecord twice = good_shift(0, 40.0);
  twice.steps = {ShiftStep::clutch_down, ShiftStep::neutral, ShiftStep::clutch_up,
                 ShiftStep::clutch_down, ShiftStep::gear,    ShiftStep::clutch_up};
  twice.lever_time = 0.35;
  twice.clutch_time = 0.3;
  twice.clutch_lag = -0.25;
  std::vector<ShownShift> shifts{chosen(twice)};
  shifts[0].chosen.errors = {make_driving_error(ErrorKind::clutch_early, Severity::severe, twice.end, 0.25, 0)};
  const std::string unknown = timeline_svg(shifts);
  CHECK(bars_of(unknown, kClutch).empty());
  CHECK(bars_of(unknown, kRed).empty());
  CHECK(unknown.find("down 2 times") != std::string::npos);
  CHECK(unknown.find("0.30 s clutch") != std::string::npos);

  shifts[0].recorded.emplace();
  shifts[0].recorded->presses = {{0.0, 0.2}, {0.3, 0.4}};
  const std::string known = timeline_svg(shifts);
  const auto clutch = bars_of(known, kClutch), lever = bars_of(known, kLever), red = bars_of(known, kRed);
  REQUIRE(clutch.size() == 2);
  REQUIRE(lever.size() == 1);
  REQUIRE(red.size() == 2);
  const double second = lever[0].width / 0.35, begin = lever[0].x - 0.1 * second;
  CHECK((clutch[0].width + clutch[1].width) / second ==
        doctest::Approx(0.3).epsilon(1e-3));  // the record's clutch_time
  CHECK((red[0].x - begin) / second == doctest::Approx(0.2).epsilon(1e-3));
  CHECK(red[0].width / second == doctest::Approx(0.1).epsilon(1e-3));
  CHECK((red[1].x - begin) / second == doctest::Approx(0.4).epsilon(1e-3));
  CHECK(red[1].width / second == doctest::Approx(0.05).epsilon(1e-3));
  // The error's tick must be at 0.2 s, where the clutch came up (0.25 s before the gear was in), and not at the shift's
  // end.
  std::vector<double> ticks;
  for (std::size_t at = 0;;) {
    const std::string_view line = between(known, "<line ", "/>", at);
    if (at == std::string::npos) break;
    if (line.find(kRed) != std::string_view::npos)
      ticks.push_back(std::stod(std::string(between(line, "x1=\"", "\""))));
  }
  REQUIRE(ticks.size() == 2);  // the first tick is in the legend
  CHECK((ticks[1] - begin) / second == doctest::Approx(0.2).epsilon(1e-3));
  CHECK(known.find("driving error") != std::string::npos);
}
