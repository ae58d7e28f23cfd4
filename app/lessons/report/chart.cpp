#include "app/lessons/report/chart.h"

#include <cmath>

#include <fmt/format.h>

#include "app/base/colours.h"

namespace gearshift::lessons {
namespace {

constexpr double kTextSize = 12.0;  // [px]
constexpr double kRounding = 1e-9;  // [1] rounding tolerance as a fraction of the grid step

std::string format_tick(double value) {
  return (value < 0.0 ? "−" : "") + fmt::format("{:.6g}", std::abs(value));
}

template <class Visit>
void each_multiple(ChartRange range, double step, const Visit& visit) {
  const auto last = static_cast<long>(std::floor(range.to / step + kRounding));
  for (auto i = static_cast<long>(std::ceil(range.from / step - kRounding)); i <= last; ++i)
    visit(static_cast<double>(i) * step);
}

}  // namespace

glm::dvec2 Chart::at(double x, double y) const noexcept {
  return {box_.x + box_.width * (x - x_.from) / (x_.to - x_.from),
          box_.bottom() - box_.height * (y - y_.from) / (y_.to - y_.from)};
}

void Chart::x_lines(double step) const {
  each_multiple(x_, step, [&](double x) { svg_.line(at(x, y_.from), at(x, y_.to), {base::kGridInk, 1.0}); });
}

void Chart::x_grid(double step) const {
  x_lines(step);
  each_multiple(x_, step, [&](double x) {
    svg_.text(at(x, y_.from) + glm::dvec2(0.0, 16.0), {kTextSize, base::kSoftInk, "middle"}, format_tick(x));
  });
}

void Chart::y_grid(double step) const {
  each_multiple(y_, step, [&](double y) {
    svg_.line(at(x_.from, y), at(x_.to, y), {base::kGridInk, 1.0});
    svg_.text(at(x_.from, y) + glm::dvec2(-8.0, 4.0), {kTextSize, base::kSoftInk, "end"}, format_tick(y));
  });
}

void Chart::x_name(std::string_view text) const {
  svg_.text({box_.x + 0.5 * box_.width, box_.bottom() + 34.0}, {kTextSize, base::kSoftInk, "middle"}, text);
}

void Chart::y_name(std::string_view text) const {
  svg_.text({box_.x, box_.y - 9.0}, {kTextSize, base::kSoftInk}, text);
}

double grid_step(double span, int max_lines) noexcept {
  const double min_step = span / max_lines;
  const double power = std::pow(10.0, std::floor(std::log10(min_step)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= min_step * (1.0 - kRounding)) return step * power;
  }
  return 10.0 * power;
}

}  // namespace gearshift::lessons
