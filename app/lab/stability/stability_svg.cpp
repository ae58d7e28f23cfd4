#include "app/lab/stability/stability_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/base/chart.h"
#include "app/base/colours.h"
#include "app/base/svg.h"
#include "app/lab/stability/stability_report.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kPixels = 6.0;  // [px] per unit of the page
constexpr base::Rect kPage{0.0, 0.0, 198.0, 122.0};
constexpr base::Rect kPlot{24.0, 28.0, 122.0, 78.0};
constexpr double kLeft = 4.0;
constexpr double kLegendLine = 6.0;
constexpr double kDot = 0.9, kRing = 1.5;  // at B = 0, the ring ends before the numbers of the axis
constexpr const char* kStableColour = "#e3eef8";
constexpr const char* kDash = "1.6 1.6";
constexpr std::array<const char*, 4> kHandColours = {base::kGearColour, "#2e8b57", base::kBufferColour, "#7b4ba8"};

// Stiffness [N/m] at the bottom and the top of the plot.
base::Scale stiffness_scale(const StabilityQuestion& question, const StabilityMap& map) {
  double lowest = 1e9, highest = 1.0;
  const auto include = [&](double stiffness) {
    if (stiffness <= 0.0 || std::isinf(stiffness)) return;
    lowest = std::min(lowest, stiffness);
    highest = std::max(highest, stiffness);
  };
  include(question.wall.stiffness);
  if (!map.passive.empty()) include(map.passive.front());
  for (const std::vector<double>& limits : map.limits) {
    include(limits.front());
    include(*std::max_element(limits.begin(), limits.end()));
  }
  const double low = std::floor(std::log10(std::min(lowest, 0.5 * highest)));
  return base::Scale::decades(std::pow(10.0, low), base::grid_step(1.1 * highest, 1));
}

class MapPlot {
 public:
  MapPlot(base::Svg& svg, const StabilityQuestion& question, const StabilityMap& map)
      : svg_(svg),
        wall_(question.wall),
        end_(map.damping.back()),
        stiffness_(stiffness_scale(question, map)),
        chart_(svg, kPlot, {0.0, end_}, stiffness_, 2.6) {}

  void grid() {
    svg_.rect(kPlot, base::kFreeColour);
    chart_.x_grid(base::grid_step(end_, 7));
    chart_.y_grid();
    chart_.x_name("damping B of the wall [N s/m]");
    chart_.y_name("stiffness K of the wall [N/m]");
  }

  // Fills the area below the limits of all hands.
  void stable_area(const StabilityMap& map) {
    std::vector<dvec2> area{{end_, 0.0}, {0.0, 0.0}};
    for (std::size_t i = 0; i < map.damping.size(); ++i) {
      double lowest = map.limits.front()[i];
      for (const std::vector<double>& limits : map.limits) lowest = std::min(lowest, limits[i]);
      area.emplace_back(map.damping[i], lowest);
    }
    chart_.area(area, kStableColour);
  }

  void curve(const std::vector<double>& damping, const std::vector<double>& limits, const base::Pen& pen) {
    std::vector<dvec2> points;
    for (std::size_t i = 0; i < limits.size(); ++i) points.emplace_back(damping[i], limits[i]);
    chart_.curve(points, pen);
  }

  void point(const char* colour) {
    const dvec2 at = chart_.at(wall_.damping, std::max(wall_.stiffness, stiffness_.from()));
    svg_.dot(at, kDot, colour);
    svg_.ring(at, kRing, {colour, 0.4});
  }

  void frame() { svg_.frame(kPlot, "none", {base::kSoftInk, 0.3}); }

 private:
  base::Svg& svg_;
  haptics::ContactLaw wall_;
  double end_;  // [N s/m] damping at the right edge
  base::Scale stiffness_;
  base::Chart chart_;
};

class MapLegend {
 public:
  explicit MapLegend(base::Svg& svg) : svg_(svg) {}

  void line(const base::Pen& pen, std::string_view label) {
    svg_.line(at_, at_ + dvec2(6.0, 0.0), pen);
    entry(label);
  }
  void area(std::string_view label) {
    svg_.rect({at_.x, at_.y - 1.8, 6.0, 3.6}, kStableColour);
    entry(label);
  }
  void point(const char* colour, std::string_view label) {
    svg_.dot(at_ + dvec2(3.0, 0.0), kDot, colour);
    svg_.ring(at_ + dvec2(3.0, 0.0), kRing, {colour, 0.4});
    entry(label);
  }
  void note(std::string_view label) {
    svg_.text(at_ + dvec2(8.5, -1.6), {2.4, base::kSoftInk}, label);
    at_.y += 0.6 * kLegendLine;
  }

 private:
  void entry(std::string_view label) {
    svg_.text(at_ + dvec2(8.5, 1.0), {2.8, base::kInk}, label);
    at_.y += kLegendLine;
  }

  base::Svg& svg_;
  dvec2 at_{kPlot.right() + 6.0, kPlot.y + 3.0};
};

const char* hand_colour(std::size_t hand) {
  return kHandColours[hand % kHandColours.size()];
}

void draw_legend(base::Svg& svg, const StabilityQuestion& question, const StabilityAnswer& answer) {
  MapLegend legend(svg);
  for (std::size_t i = 0; i < question.hands.size(); ++i) {
    legend.line({hand_colour(i), 0.8}, fmt::format("exact limit, {}", question.hands[i].name));
  }
  if (answer.passive_limit) {
    legend.line({base::kSoftInk, 0.6, kDash}, "passive limit");
    legend.note("(sufficient, not necessary)");
  }
  legend.area(question.hands.size() > 1 ? "stable with all hands" : "stable");
  legend.point(answer.may_use ? base::kInk : base::kLockoutColour,
               answer.may_use ? "requested wall: allowed" : "requested wall: not allowed");
  legend.note(fmt::format("K = {:g} N/m", question.wall.stiffness));
  legend.note(fmt::format("B = {:g} N s/m", question.wall.damping));
}

}  // namespace

std::string stability_svg(const StabilityQuestion& question, const StabilityAnswer& answer, const StabilityMap& map) {
  base::Svg svg(kPage, kPixels);
  svg.text({kLeft, 7.5}, {4.6, base::kInk, "start", true}, "Stable walls: largest K against B (Z-width)");
  svg.text({kLeft, 12.0}, {2.7, base::kSoftInk}, describe_device(question));
  svg.text({kLeft, 16.0}, {2.7, base::kSoftInk}, describe_loop(question));
  MapPlot plot(svg, question, map);
  plot.grid();
  plot.stable_area(map);
  for (std::size_t i = map.limits.size(); i-- > 0;) plot.curve(map.damping, map.limits[i], {hand_colour(i), 0.8});
  plot.curve(map.damping, map.passive, {base::kSoftInk, 0.6, kDash});
  plot.frame();
  plot.point(answer.may_use ? base::kInk : base::kLockoutColour);
  draw_legend(svg, question, answer);
  return std::move(svg).finish();
}

}  // namespace gearshift::lab
