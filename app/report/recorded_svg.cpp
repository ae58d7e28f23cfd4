#include "app/report/recorded_svg.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
constexpr Rect kPage{0.0, 0.0, 560.0, 340.0};
constexpr Rect kForceBox{44.0, 28.0, 502.0, 170.0};
constexpr Rect kPedalBox{44.0, 232.0, 502.0, 60.0};
constexpr double kPixelsPerMillimetre = 3.0;

constexpr double kLeastForce = 20.0;  // [N] of the scale
constexpr std::size_t kMostParts = 400;
constexpr const char* kClutchColour = "#8d99a6";
constexpr const char* kThrottleColour = "#2e7d4f";
constexpr const char* kLeverColour = "#8a2f87";

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

void draw_force(Svg& svg, const RecordedShift& shift, const std::vector<RecordedCycle>& cycles, Range time) {
  double most = kLeastForce;
  for (const RecordedCycle& cycle : cycles) most = std::max(most, 1.1 * cycle.force);
  const double step = grid_step(most, 5);
  const double top = step * std::ceil(most / step);
  const Chart chart(svg, kForceBox, time, {0.0, top});
  svg.rect({chart.at(0.0, 0.0).x, kForceBox.y, chart.at(shift.end, 0.0).x - chart.at(0.0, 0.0).x, kForceBox.height},
           kMouthShade);
  chart.y_grid(step);
  chart.x_lines(grid_step(time.to - time.from, 8));
  chart.y_name("force of the hand [N]");
  if (shift.alarm <= top)
    svg.line(chart.at(time.from, shift.alarm), chart.at(time.to, shift.alarm), {kLockoutColour, 1.5, "6 4"});
  svg.polyline(line_of(chart, cycles, [](const RecordedCycle& c) { return c.force; }), {kInk, 1.6});
}

void draw_pedals(Svg& svg, const std::vector<RecordedCycle>& cycles, Range time) {
  const Chart chart(svg, kPedalBox, time, {0.0, 1.0});
  chart.y_grid(1.0);
  chart.x_grid(grid_step(time.to - time.from, 8));
  chart.x_name("s since the shift began");
  svg.text({kPedalBox.x, kPedalBox.y - 7.0}, {12.0, kClutchColour, "start", true}, "clutch pedal");
  svg.text({kPedalBox.x + 100.0, kPedalBox.y - 7.0}, {12.0, kThrottleColour, "start", true}, "throttle");
  svg.polyline(line_of(chart, cycles, [](const RecordedCycle& c) { return std::clamp(c.clutch, 0.0, 1.0); }),
               {kClutchColour, 2.2});
  svg.polyline(line_of(chart, cycles, [](const RecordedCycle& c) { return std::clamp(c.throttle, 0.0, 1.0); }),
               {kThrottleColour, 1.6});
}

}  // namespace

std::string force_svg(const RecordedShift& shift) {
  Svg svg(kPage, 1.0);
  const std::vector<RecordedCycle> cycles = thinned(shift.cycles);
  const Range time{-kAround, shift.end + kAround};
  draw_force(svg, shift, cycles, time);
  draw_pedals(svg, cycles, time);
  return std::move(svg).finish();
}

std::string path_svg(const RecordedShift& shift) {
  const Rect plate = gate_plate(shift.gate);
  Svg svg({plate.x - 1.0, plate.y - 1.0, plate.width + 2.0, plate.height + 2.0}, kPixelsPerMillimetre);
  const GateDescription description = describe_gate(shift.gate);
  draw_gate_ground(svg, shift.gate, description);
  draw_gate_walls(svg, description);
  draw_gears(svg, shift.gate);
  const std::vector<RecordedCycle> cycles = thinned(shift.cycles);
  svg.polyline(way_of(cycles, [](const RecordedCycle& c) { return c.hand; }), {kBufferColour, 0.6});
  svg.polyline(way_of(cycles, [](const RecordedCycle& c) { return c.lever; }), {kLeverColour, 1.0});
  svg.ring(on_page(cycles.front().lever), 1.8, {kLeverColour, 0.7});
  svg.dot(on_page(cycles.back().lever), 1.8, kLeverColour);
  return std::move(svg).finish();
}

}  // namespace gearshift
