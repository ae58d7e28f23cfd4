#include "app/base/chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/base/colours.h"

namespace gearshift::base {
namespace {

constexpr double kRounding = 1e-9;  // [1] rounding tolerance as a fraction of the grid step
// Margin and least span of a logarithmic axis around given values.
constexpr double kMargin = 0.06;  // [1] at each end, as a fraction of the span
constexpr double kMinSpan = 0.6;  // [decades]
// Least distances between numbers, as multiples of their height.
constexpr double kNumberWidth = 3.6, kNumberHeight = 1.4;

// With a minus sign, and from 10 000 on with digits in groups.
std::string format_tick(double value) {
  const double size = std::abs(value);
  const bool in_groups = size >= 1e4 && size < 1e9;
  const std::string digits = in_groups ? fmt::format("{:.0f}", size) : fmt::format("{:.6g}", size);
  std::string text = value < 0.0 ? "−" : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (in_groups && i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

}  // namespace

Scale Scale::decades(double from, double to) {
  Scale scale(from, to);
  scale.logarithmic_ = true;
  return scale;
}

Scale Scale::decades_around(const std::vector<double>& values) {
  double low = INFINITY, high = -INFINITY;
  bool zero = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    zero = zero || value <= 0.0;
    if (value <= 0.0) continue;
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  if (low > high) low = high = 0.0;
  const double span = std::max(kMinSpan, high - low), middle = 0.5 * (low + high);
  const double reach = (0.5 + kMargin) * span;
  Scale scale = decades(std::pow(10.0, middle - reach - (zero ? 1.0 : 0.0)), std::pow(10.0, middle + reach));
  scale.zero_ = zero;
  return scale;
}

double Scale::fraction(double value) const noexcept {
  if (!logarithmic_) return (value - from_) / (to_ - from_);
  if (value <= 0.0) return zero_ ? 0.0 : -1.0;
  return std::clamp(std::log10(value / from_) / std::log10(to_ / from_), -1.0, 1.0);
}

std::vector<Scale::Tick> Scale::ticks(double step, double max_named) const {
  std::vector<Tick> ticks;
  if (!logarithmic_) {
    const auto last = static_cast<long>(std::floor(to_ / step + kRounding));
    for (auto i = static_cast<long>(std::ceil(from_ / step - kRounding)); i <= last; ++i)
      ticks.push_back({static_cast<double>(i) * step, true});
    return ticks;
  }
  if (zero_) ticks.push_back({0.0, true});
  const double low = std::log10(from_) + (zero_ ? 1.0 : 0.0), high = std::log10(to_);
  const bool has_room = high - low <= std::log10(2.0) * max_named;
  const int each = has_room ? 1 : std::max(1, static_cast<int>(std::ceil((high - low) / max_named)));
  for (int power = static_cast<int>(std::floor(low)); power <= static_cast<int>(std::ceil(high)); ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10.0, power);
      const bool is_inside = std::log10(value) >= low - kRounding && std::log10(value) <= high + kRounding;
      if (is_inside && (digit == 1.0 || has_room)) ticks.push_back({value, power % each == 0});
    }
  }
  return ticks;
}

glm::dvec2 Chart::at(double x, double y) const noexcept {
  return {box_.x + box_.width * x_.fraction(x), box_.bottom() - box_.height * y_.fraction(y)};
}

Pen Chart::grid_pen(bool is_zero) const noexcept {
  return {is_zero ? kSoftInk : kGridInk, text_ / 12.0};
}

std::vector<Scale::Tick> Chart::x_ticks(double step) const {
  return x_.ticks(step, box_.width / (kNumberWidth * text_));
}

void Chart::x_lines(double step) const {
  for (const Scale::Tick& tick : x_ticks(step)) {
    const double x = at(tick.value, y_.from()).x;
    svg_.line({x, box_.bottom()}, {x, box_.y}, grid_pen());
  }
}

void Chart::x_grid(double step) const {
  x_lines(step);
  for (const Scale::Tick& tick : x_ticks(step)) {
    const double x = at(tick.value, y_.from()).x;
    if (tick.named)
      svg_.text({x, box_.bottom() + 4.0 / 3.0 * text_}, {text_, kSoftInk, "middle"}, format_tick(tick.value));
  }
}

void Chart::y_grid(double step) const {
  for (const Scale::Tick& tick : y_.ticks(step, box_.height / (kNumberHeight * text_))) {
    const double y = at(x_.from(), tick.value).y;
    svg_.line({box_.x, y}, {box_.right(), y}, grid_pen(tick.value == 0.0 && y_.from() < 0.0));
    if (tick.named)
      svg_.text({box_.x - 2.0 / 3.0 * text_, y + text_ / 3.0}, {text_, kSoftInk, "end"}, format_tick(tick.value));
  }
}

void Chart::x_name(std::string_view text) const {
  svg_.text({box_.x + 0.5 * box_.width, box_.bottom() + 17.0 / 6.0 * text_}, {text_, kSoftInk, "middle"}, text);
}

void Chart::y_name(std::string_view text) const {
  svg_.text({box_.x, box_.y - 0.75 * text_}, {text_, kSoftInk}, text);
}

// A straight line between data points is curved on a logarithmic axis, so it is drawn in parts.
std::vector<glm::dvec2> Chart::on_page(const std::vector<glm::dvec2>& data) const {
  constexpr int kParts = 20;
  std::vector<glm::dvec2> points;
  points.reserve(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    const glm::dvec2 end = data[i], begin = data[i > 0 ? i - 1 : 0];
    const bool is_curved = y_.is_logarithmic() && std::isfinite(begin.y) && std::isfinite(end.y);
    for (int part = 1; is_curved && begin != end && part < kParts; ++part) {
      const glm::dvec2 between = begin + (end - begin) * (1.0 * part / kParts);
      points.push_back(at(between.x, between.y));
    }
    points.push_back(at(end.x, end.y));
  }
  return points;
}

void Chart::curve(const std::vector<glm::dvec2>& data, const Pen& pen) const {
  const double half = 0.5 * pen.width;
  svg_.begin_clip({box_.x - half, box_.y - half, box_.width + pen.width, box_.height + pen.width});
  svg_.polyline(on_page(data), pen);
  svg_.end_clip();
}

void Chart::area(const std::vector<glm::dvec2>& data, std::string_view fill) const {
  svg_.begin_clip(box_);
  svg_.polygon(on_page(data), fill);
  svg_.end_clip();
}

double grid_step(double span, int max_lines) noexcept {
  const double min_step = span / max_lines;
  const double power = std::pow(10.0, std::floor(std::log10(min_step)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= min_step * (1.0 - kRounding)) return step * power;
  }
  return 10.0 * power;
}

void draw_curve(Svg& svg, const Rect& box, const Curve& curve, double text) {
  if (curve.points.empty()) return;
  double low = 0.0, high = 1.0;
  for (const glm::dvec2& point : curve.points) {
    low = std::min(low, 1.05 * point.y);
    high = std::max(high, 1.05 * point.y);
  }
  const Chart chart(svg, box, Scale::decades(curve.points.front().x, curve.points.back().x), {low, high}, text);
  svg.rect(box, kFreeColour);
  chart.x_grid();
  chart.y_grid(grid_step(high - low, 6));
  chart.x_name(curve.x_name);
  chart.y_name(curve.y_name);
  chart.curve(curve.points, {kGearColour, 0.3 * text});
  for (const glm::dvec2& point : curve.points) svg.dot(chart.at(point.x, point.y), 0.3 * text, kGearColour);
  svg.frame(box, "none", {kSoftInk, 0.1 * text});
}

}  // namespace gearshift::base
