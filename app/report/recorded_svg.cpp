#include "app/report/recorded_svg.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/draw/gate_colours.h"
#include "app/draw/gate_outline.h"
#include "app/report/chart.h"
#include "haptics/gate/gate_description.h"

namespace gearshift {
namespace {

// Sizes on the page. [px]
constexpr double kWidth = 560.0, kLeft = 44.0, kInner = 502.0;
constexpr Rect kForceBox{kLeft, 28.0, kInner, 150.0};
constexpr double kSpeedHeight = 110.0, kPedalHeight = 50.0, kGearHeight = 16.0;
constexpr double kGap = 30.0;   // above each chart, for its name
constexpr double kAxis = 44.0;  // below the last one
constexpr double kPixelsPerMillimetre = 3.0;

constexpr double kLeastForce = 20.0;  // [N] of the scale
constexpr double kLeastSpan = 500.0;  // [1/min] of the scale
constexpr double kPerMinute = 30.0 / std::numbers::pi;
constexpr std::size_t kMostParts = 400;
constexpr const char* kPedalColour = "#8d99a6";
constexpr const char* kThrottleColour = "#2e7d4f";
constexpr const char* kLeverColour = "#8a2f87";
constexpr const char* kGearGround = "#cfe0f2";
constexpr const char* kShaftColour = "#d9822b";
constexpr const char* kIdealColour = "#2e7d4f";

// Even parts of the recording, the lowest and highest force of each kept: no peak is lost.
std::vector<RecordedCycle> thinned(const std::vector<RecordedCycle>& cycles) {
  const std::size_t part = std::max<std::size_t>(1, cycles.size() / kMostParts);
  std::vector<RecordedCycle> kept;
  for (std::size_t i = 0; i < cycles.size(); i += part) {
    const auto from = cycles.begin() + static_cast<std::ptrdiff_t>(i);
    const auto to = cycles.begin() + static_cast<std::ptrdiff_t>(std::min(i + part, cycles.size()));
    auto [low, high] =
        std::minmax_element(from, to, [](const RecordedCycle& a, const RecordedCycle& b) { return a.force < b.force; });
    if (high < low) std::swap(low, high);
    kept.push_back(*low);
    if (high != low) kept.push_back(*high);
  }
  return kept;
}

template <class Value>
std::vector<glm::dvec2> line_of(const Chart& chart, const std::vector<RecordedCycle>& cycles, const Value& value) {
  std::vector<glm::dvec2> points;
  points.reserve(cycles.size());
  for (const RecordedCycle& cycle : cycles) points.push_back(chart.at(cycle.time, value(cycle)));
  return points;
}

template <class Place>
std::vector<glm::dvec2> way_of(const std::vector<RecordedCycle>& cycles, const Place& place) {
  std::vector<glm::dvec2> points;
  points.reserve(cycles.size());
  for (const RecordedCycle& cycle : cycles) points.push_back(on_page(place(cycle)));
  return points;
}

// The charts of one shift, one below the other on one time axis.
class ShiftCharts {
 public:
  ShiftCharts(Svg& svg, const ShiftRecording& shift)
      : svg_(svg), shift_(shift), cycles_(thinned(shift.cycles)), time_{-kAround, shift.end + kAround} {}

  void force() {
    double most = kLeastForce;
    for (const RecordedCycle& cycle : cycles_) most = std::max(most, 1.1 * cycle.force);
    const double step = grid_step(most, 5);
    const double top = step * std::ceil(most / step);
    const Chart chart = begin(kForceBox, {0.0, top}, step);
    chart.y_name("force of the hand [N]");
    if (shift_.alarm <= top)
      svg_.line(chart.at(time_.from, shift_.alarm), chart.at(time_.to, shift_.alarm), {kLockoutColour, 1.5, "6 4"});
    draw(chart, {kInk, 1.6}, [](const RecordedCycle& c) { return c.force; });
  }

  // Not from nought: where the two meet is to be seen.
  void speeds(const Rect& box) {
    double least = 1e9, most = 0.0;
    for (const RecordedCycle& c : cycles_) {
      least = std::min({least, kPerMinute * c.engine_speed, kPerMinute * c.shaft_speed});
      most = std::max({most, kPerMinute * c.engine_speed, kPerMinute * c.shaft_speed});
    }
    most = std::max(most, least + kLeastSpan);
    const double step = grid_step(most - least, 4);
    const Chart chart = begin(box, {step * std::floor(least / step), step * std::ceil(most / step)}, step);
    name(box, 0.0, kGearColour, "engine [1/min]");
    name(box, 110.0, kShaftColour, "gearbox shaft [1/min]");
    draw(chart, {kShaftColour, 2.2}, [](const RecordedCycle& c) { return kPerMinute * c.shaft_speed; });
    draw(chart, {kGearColour, 1.6}, [](const RecordedCycle& c) { return kPerMinute * c.engine_speed; });
  }

  void pedals(const Rect& box) {
    const Chart chart = begin(box, {0.0, 1.0}, 1.0);
    name(box, 0.0, kPedalColour, "clutch pedal");
    name(box, 100.0, kThrottleColour, "throttle");
    draw(chart, {kPedalColour, 2.2}, [](const RecordedCycle& c) { return std::clamp(c.clutch, 0.0, 1.0); });
    draw(chart, {kThrottleColour, 1.6}, [](const RecordedCycle& c) { return std::clamp(c.throttle, 0.0, 1.0); });
  }

  // A strip: a box a gear, none in neutral.
  void gears(const Rect& box) {
    const Chart chart(svg_, box, time_, {0.0, 1.0});
    svg_.text({box.x - 8.0, box.bottom() - 4.0}, {12.0, kSoftInk, "end"}, "gear");
    chart.x_grid(grid_step(time_.to - time_.from, 8));
    chart.x_name("s since the shift began");
    svg_.rect(box, kAisleShade, 2.0);
    for (std::size_t i = 0; i < cycles_.size();) {
      const std::size_t first = i;
      while (i < cycles_.size() && cycles_[i].gear == cycles_[first].gear) ++i;
      const double from = chart.at(cycles_[first].time, 0.0).x;
      const double to = i < cycles_.size() ? chart.at(cycles_[i].time, 0.0).x : chart.at(cycles_.back().time, 0.0).x;
      gear({from, box.y, to - from, box.height}, cycles_[first].gear);
    }
  }

 private:
  // Shaded where the shift is.
  Chart begin(const Rect& box, Range values, double step) {
    const Chart chart(svg_, box, time_, values);
    const double from = chart.at(0.0, 0.0).x;
    svg_.rect({from, box.y, chart.at(shift_.end, 0.0).x - from, box.height}, kMouthShade);
    chart.y_grid(step);
    chart.x_lines(grid_step(time_.to - time_.from, 8));
    return chart;
  }

  void name(const Rect& box, double x, const char* colour, std::string_view words) {
    svg_.text({box.x + x, box.y - 7.0}, {12.0, colour, "start", true}, words);
  }

  template <class Value>
  void draw(const Chart& chart, const Pen& pen, const Value& value) {
    svg_.polyline(line_of(chart, cycles_, value), pen);
  }

  void gear(const Rect& box, int gear) {
    if (gear != kNeutralGear) svg_.rect(box, kGearGround, 2.0);
    if (box.width < kGearHeight) return;
    svg_.text({box.x + 0.5 * box.width, box.bottom() - 4.0}, {12.0, gear == kNeutralGear ? kSoftInk : kInk, "middle"},
              gear_name(gear));
  }

  Svg& svg_;
  const ShiftRecording& shift_;
  std::vector<RecordedCycle> cycles_;
  Range time_;
};

Rect below(const Rect& box, double gap, double height) {
  return {box.x, box.bottom() + gap, box.width, height};
}

std::vector<glm::dvec2> line_on_page(const std::vector<glm::dvec2>& way) {
  std::vector<glm::dvec2> points;
  for (const glm::dvec2 place : way) points.push_back(on_page(place));
  return points;
}

}  // namespace

std::string force_svg(const ShiftRecording& shift) {
  const Rect speeds = below(kForceBox, kGap, kSpeedHeight);
  const Rect pedals = below(shift.has_car ? speeds : kForceBox, kGap, kPedalHeight);
  const Rect gears = below(pedals, 6.0, kGearHeight);
  Svg svg({0.0, 0.0, kWidth, gears.bottom() + kAxis}, 1.0);
  ShiftCharts charts(svg, shift);
  charts.force();
  if (shift.has_car) charts.speeds(speeds);
  charts.pedals(pedals);
  charts.gears(gears);
  return std::move(svg).finish();
}

std::string path_svg(const ShiftRecording& shift) {
  const Rect plate = gate_plate(shift.gate);
  Svg svg({plate.x - 1.0, plate.y - 1.0, plate.width + 2.0, plate.height + 2.0}, kPixelsPerMillimetre);
  const GateDescription description = describe_gate(shift.gate);
  draw_gate_ground(svg, shift.gate, description);
  draw_gate_walls(svg, description);
  draw_gears(svg, shift.gate);
  const std::vector<RecordedCycle> cycles = thinned(shift.cycles);
  svg.polyline(way_of(cycles, [](const RecordedCycle& c) { return c.hand; }), {kBufferColour, 0.6});
  svg.polyline(way_of(cycles, [](const RecordedCycle& c) { return c.lever; }), {kLeverColour, 1.0});
  svg.polyline(line_on_page(shift.ideal), {kIdealColour, 0.7, "1.6 1.4"});
  svg.ring(on_page(cycles.front().lever), 1.8, {kLeverColour, 0.7});
  svg.dot(on_page(cycles.back().lever), 1.8, kLeverColour);
  return std::move(svg).finish();
}

}  // namespace gearshift
