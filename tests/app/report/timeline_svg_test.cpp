// Bars are as long, and begin, as the shift's times say.
#include "app/report/timeline_svg.h"

#include <doctest/doctest.h>

#include "tests/app/report/constructed_history.h"
#include "tests/app/report/page_parts.h"

using namespace gearshift;

namespace {

constexpr const char* kClutch = "#8d99a6";
constexpr const char* kLever = "#1f5fa8";
constexpr const char* kRed = "#c5303b";

struct Bar {
  double x = 0.0, width = 0.0;
};

// Of that colour, the legend's one left out.
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

ChosenShift chosen(const ShiftRecord& shift) {
  return {7, "drill", "", shift, {}, 0.0};
}

}  // namespace

TEST_CASE("clutch and lever on one axis: 0.5 s of clutch, of which the lever goes from 0.10 to 0.35 s") {
  const std::vector<ChosenShift> shifts{chosen(good_shift(2, 40.0))};
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

TEST_CASE("red: the lever's way without the clutch, before it was down and after it came up") {
  ShiftRecord early = good_shift(0, 40.0), late = good_shift(0, 40.0);
  early.clutch_lag = -0.05;
  late.clutch_lead = -0.08;
  const std::vector<ChosenShift> shifts{chosen(early), chosen(late)};
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

TEST_CASE("who waits a minute with the clutch down does not squeeze the others: the axis ends at 8 s") {
  ShiftRecord waits = good_shift(0, 40.0);
  waits.clutch_lead = 60.0;
  waits.clutch_time = 60.4;
  waits.end = waits.begin + 60.5;
  const std::vector<ChosenShift> shifts{chosen(waits), chosen(good_shift(1, 40.0))};
  const auto clutch = bars_of(timeline_svg(shifts), kClutch);
  REQUIRE(clutch.size() == 2);
  CHECK(clutch[0].width / clutch[1].width == doctest::Approx(8.0 / 0.5).epsilon(1e-3));
}
