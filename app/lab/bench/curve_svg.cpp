#include "app/lab/bench/curve_svg.h"

#include <algorithm>
#include <utility>

#include "app/base/colours.h"
#include "app/base/svg.h"

namespace gearshift::lab {
namespace {

constexpr double kCurveWidth = 480.0, kCurveHeight = 220.0;  // [px] of a curve with its axes
constexpr base::Rect kCurveBox{64.0, 50.0, 392.0, 120.0};    // [px] of its plot, from the corner
constexpr glm::dvec2 kCurveTitle{64.0, 20.0};                // [px] of the row's name, from the corner

}  // namespace

std::string curve_svg(std::string_view family, const std::vector<BenchRow>& rows) {
  std::vector<const BenchRow*> drawn;
  std::size_t columns = 0;
  for (const BenchRow& row : rows) {
    if (row.family != family || row.curves.empty()) continue;
    drawn.push_back(&row);
    columns = std::max(columns, row.curves.size());
  }
  if (drawn.empty()) return {};
  base::Svg svg(
      {0.0, 0.0, kCurveWidth * static_cast<double>(columns), kCurveHeight * static_cast<double>(drawn.size())}, 1.0);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double y = kCurveHeight * static_cast<double>(i);
    svg.text(kCurveTitle + glm::dvec2(0.0, y), {14.0, base::kInk, "start", true}, drawn[i]->name);
    for (std::size_t k = 0; k < drawn[i]->curves.size(); ++k) {
      const double x = kCurveWidth * static_cast<double>(k);
      draw_curve(svg, {x + kCurveBox.x, y + kCurveBox.y, kCurveBox.width, kCurveBox.height}, drawn[i]->curves[k], 12.0);
    }
  }
  return std::move(svg).finish();
}

}  // namespace gearshift::lab
