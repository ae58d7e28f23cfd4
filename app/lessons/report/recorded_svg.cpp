#include "app/lessons/report/recorded_svg.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/base/chart.h"
#include "app/base/colours.h"
#include "app/lessons/report/gate_outline.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate_description.h"

namespace gearshift::lessons {
namespace {

// Sizes on the page. [px]
constexpr double kWidth = 560.0, kLeft = 44.0, kInner = 502.0;
constexpr base::Rect kForceBox{kLeft, 28.0, kInner, 150.0};
constexpr double kSpeedHeight = 110.0, kPedalHeight = 50.0, kGearHeight = 16.0;
constexpr double kGap = 30.0;   // space for the label above each chart
constexpr double kAxis = 44.0;  // space below the last chart
constexpr double kPixelsPerMillimetre = 3.0;

constexpr double kMinForceScale = 20.0;  // [N] smallest range of the force axis
constexpr double kMinSpeedSpan = 500.0;  // [1/min] smallest range of the speed axis
constexpr std::size_t kMaxParts = 400;
constexpr const char* kPedalColour = "#8d99a6";
constexpr const char* kThrottleColour = "#2e7d4f";
constexpr const char* kLeverColour = "#8a2f87";
constexpr const char* kGearGround = "#cfe0f2";
constexpr const char* kShaftColour = "#d9822b";
constexpr const char* kIdealColour = "#2e7d4f";

// Splits the recording into equal parts and keeps the lowest and the highest force of each part, so that no peak is
// lost.
std::vector<RecordedCycle> thin_out(const std::vector<RecordedCycle>& cycles) {
  const std::size_t part = std::max<std::size_t>(1, cycles.size() / kMaxParts);
  std::vector<RecordedCycle> thinned;
  for (std::size_t i = 0; i < cycles.size(); i += part) {
    const auto from = cycles.begin() + static_cast<std::ptrdiff_t>(i);
    const auto to = cycles.begin() + static_cast<std::ptrdiff_t>(std::min(i + part, cycles.size()));
    auto [low, high] =
        std::minmax_element(from, to, [](const RecordedCycle& a, const RecordedCycle& b) { return a.force < b.force; });
    if (high < low) std::swap(low, high);
    thinned.push_back(*low);
    if (high != low) thinned.push_back(*high);
  }
  return thinned;
}

template <class Place>
std::vector<glm::dvec2> points_of(const std::vector<RecordedCycle>& cycles, const Place& place) {
  std::vector<glm::dvec2> points;
  points.reserve(cycles.size());
  for (const RecordedCycle& cycle : cycles) points.push_back(place(cycle));
  return points;
}

// The charts of one shift, stacked on a common time axis.
class ShiftCharts {
 public:
  ShiftCharts(base::Svg& svg, const ShiftRecording& shift)
      : svg_(svg),
        shift_(shift),
        cycles_(thin_out(shift.cycles)),
        time_{-kRecordingMargin, shift.end + kRecordingMargin} {}

  void force() {
    double max_force = kMinForceScale;
    for (const RecordedCycle& cycle : cycles_) max_force = std::max(max_force, 1.1 * cycle.force);
    const double step = base::grid_step(max_force, 5);
    const double top = step * std::ceil(max_force / step);
    const base::Chart chart = begin(kForceBox, {0.0, top}, step);
    chart.y_name("hand force [N]");
    if (shift_.alarm <= top)
      chart.curve({{time_.from(), shift_.alarm}, {time_.to(), shift_.alarm}}, {base::kLockoutColour, 1.5, "6 4"});
    draw(chart, {base::kInk, 1.6}, [](const RecordedCycle& c) { return c.force; });
  }

  // The axis does not start at zero, to show clearly where the two speeds meet.
  void speeds(const base::Rect& box) {
    double low = 1e9, high = 0.0;
    for (const RecordedCycle& c : cycles_) {
      low = std::min({low, c.engine_speed / haptics::kTurnPerMinute, c.shaft_speed / haptics::kTurnPerMinute});
      high = std::max({high, c.engine_speed / haptics::kTurnPerMinute, c.shaft_speed / haptics::kTurnPerMinute});
    }
    high = std::max(high, low + kMinSpeedSpan);
    const double step = base::grid_step(high - low, 4);
    const base::Chart chart = begin(box, {step * std::floor(low / step), step * std::ceil(high / step)}, step);
    name(box, 0.0, base::kGearColour, "engine [1/min]");
    name(box, 110.0, kShaftColour, "gearbox shaft [1/min]");
    draw(chart, {kShaftColour, 2.2}, [](const RecordedCycle& c) { return c.shaft_speed / haptics::kTurnPerMinute; });
    draw(chart, {base::kGearColour, 1.6},
         [](const RecordedCycle& c) { return c.engine_speed / haptics::kTurnPerMinute; });
  }

  void pedals(const base::Rect& box) {
    const base::Chart chart = begin(box, {0.0, 1.0}, 1.0);
    name(box, 0.0, kPedalColour, "clutch pedal");
    name(box, 100.0, kThrottleColour, "throttle");
    draw(chart, {kPedalColour, 2.2}, [](const RecordedCycle& c) { return std::clamp(c.clutch, 0.0, 1.0); });
    draw(chart, {kThrottleColour, 1.6}, [](const RecordedCycle& c) { return std::clamp(c.throttle, 0.0, 1.0); });
  }

  // A strip with one box per gear; no box in neutral.
  void gears(const base::Rect& box) {
    const base::Chart chart(svg_, box, time_, {0.0, 1.0});
    svg_.text({box.x - 8.0, box.bottom() - 4.0}, {12.0, base::kSoftInk, "end"}, "gear");
    chart.x_grid(base::grid_step(time_.to() - time_.from(), 8));
    chart.x_name("time since the shift began [s]");
    svg_.rect(box, base::kAisleShade, 2.0);
    for (std::size_t i = 0; i < cycles_.size();) {
      const std::size_t first = i;
      while (i < cycles_.size() && cycles_[i].gear == cycles_[first].gear) ++i;
      const double from = chart.at(cycles_[first].time, 0.0).x;
      const double to = i < cycles_.size() ? chart.at(cycles_[i].time, 0.0).x : chart.at(cycles_.back().time, 0.0).x;
      gear({from, box.y, to - from, box.height}, cycles_[first].gear);
    }
  }

 private:
  // Starts a chart; shades the duration of the shift.
  base::Chart begin(const base::Rect& box, base::Scale values, double step) {
    const base::Chart chart(svg_, box, time_, values);
    const double from = chart.at(0.0, 0.0).x;
    svg_.rect({from, box.y, chart.at(shift_.end, 0.0).x - from, box.height}, base::kMouthShade);
    chart.y_grid(step);
    chart.x_lines(base::grid_step(time_.to() - time_.from(), 8));
    return chart;
  }

  void name(const base::Rect& box, double x, const char* colour, std::string_view words) {
    svg_.text({box.x + x, box.y - 7.0}, {12.0, colour, "start", true}, words);
  }

  template <class Value>
  void draw(const base::Chart& chart, const base::Pen& pen, const Value& value) {
    chart.curve(points_of(cycles_, [&](const RecordedCycle& c) { return glm::dvec2(c.time, value(c)); }), pen);
  }

  void gear(const base::Rect& box, int gear) {
    if (gear != haptics::kNeutralGear) svg_.rect(box, kGearGround, 2.0);
    if (box.width < kGearHeight) return;
    svg_.text({box.x + 0.5 * box.width, box.bottom() - 4.0},
              {12.0, gear == haptics::kNeutralGear ? base::kSoftInk : base::kInk, "middle"}, haptics::gear_name(gear));
  }

  base::Svg& svg_;
  const ShiftRecording& shift_;
  std::vector<RecordedCycle> cycles_;
  base::Scale time_;
};

base::Rect below(const base::Rect& box, double gap, double height) {
  return {box.x, box.bottom() + gap, box.width, height};
}

std::vector<glm::dvec2> path_on_page(const std::vector<glm::dvec2>& path) {
  std::vector<glm::dvec2> points;
  for (const glm::dvec2 place : path) points.push_back(on_page(place));
  return points;
}

}  // namespace

std::string force_svg(const ShiftRecording& shift) {
  const base::Rect speeds = below(kForceBox, kGap, kSpeedHeight);
  const base::Rect pedals = below(shift.has_car ? speeds : kForceBox, kGap, kPedalHeight);
  const base::Rect gears = below(pedals, 6.0, kGearHeight);
  base::Svg svg({0.0, 0.0, kWidth, gears.bottom() + kAxis}, 1.0);
  ShiftCharts charts(svg, shift);
  charts.force();
  if (shift.has_car) charts.speeds(speeds);
  charts.pedals(pedals);
  charts.gears(gears);
  return std::move(svg).finish();
}

std::string path_svg(const ShiftRecording& shift) {
  const base::Rect plate = gate_plate(shift.gate);
  base::Svg svg({plate.x - 1.0, plate.y - 1.0, plate.width + 2.0, plate.height + 2.0}, kPixelsPerMillimetre);
  const haptics::GateDescription description = haptics::describe_gate(shift.gate);
  draw_gate_ground(svg, shift.gate, description);
  draw_gate_walls(svg, description);
  draw_gears(svg, shift.gate);
  const std::vector<RecordedCycle> cycles = thin_out(shift.cycles);
  svg.polyline(points_of(cycles, [](const RecordedCycle& c) { return on_page(c.hand); }), {base::kBufferColour, 0.6});
  svg.polyline(points_of(cycles, [](const RecordedCycle& c) { return on_page(c.lever); }), {kLeverColour, 1.0});
  svg.polyline(path_on_page(shift.ideal), {kIdealColour, 0.7, "1.6 1.4"});
  svg.ring(on_page(cycles.front().lever), 1.8, {kLeverColour, 0.7});
  svg.dot(on_page(cycles.back().lever), 1.8, kLeverColour);
  return std::move(svg).finish();
}

}  // namespace gearshift::lessons
