#include "app/lab/stability/stability_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

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
constexpr const char* kStableColour = "#e3eef8";
constexpr const char* kDash = "1.6 1.6";
constexpr std::array<const char*, 4> kHandColours = {base::kGearColour, "#2e8b57", base::kBufferColour, "#7b4ba8"};

// Rounds up to 1, 2 or 5 times a power of ten.
double round_up(double number) {
  const double power = std::pow(10.0, std::floor(std::log10(number)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (number <= factor * power) return factor * power;
  }
  return 10.0 * power;
}

// Groups digits: 1000000 becomes "1 000 000".
std::string grouped(double number) {
  const std::string digits = fmt::format("{:.15g}", number);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && number >= 1000.0 && (digits.size() - i) % 3 == 0) out += ' ';
    out += digits[i];
  }
  return out;
}

class MapPlot {
 public:
  MapPlot(base::Svg& svg, const StabilityQuestion& question, const StabilityMap& map)
      : svg_(svg), end_(map.damping.back()), wanted_(question.wall.stiffness) {
    include_stiffness(wanted_);
    if (!map.passive.empty()) include_stiffness(map.passive.front());
    for (const std::vector<double>& limits : map.limits) {
      include_stiffness(limits.front());
      include_stiffness(*std::max_element(limits.begin(), limits.end()));
    }
    low_ = std::floor(std::log10(std::min(lowest_, 0.5 * highest_)));
    high_ = std::log10(round_up(1.1 * highest_));
  }

  void grid() {
    svg_.rect(kPlot, base::kFreeColour);
    for (double decade = low_; decade <= high_; ++decade) {
      for (const double digit : {1.0, 2.0, 5.0}) k_line(digit * std::pow(10.0, decade), digit == 1.0);
    }
    const double step = round_up(end_ / 7.0);
    for (int i = 0; i * step <= end_; ++i) b_line(i * step);
    const base::Type name{3.0, base::kInk, "middle"};
    svg_.text({kPlot.x + 0.5 * kPlot.width, kPlot.bottom() + 11.0}, name, "damping B of the wall [N s/m]");
    svg_.text({kLeft, kPlot.y - 3.5}, {3.0, base::kInk}, "stiffness K of the wall [N/m]");
  }

  // Fills the area below the limits of all hands.
  void stable_area(const StabilityMap& map) {
    std::vector<double> lowest = map.limits.front();
    for (const std::vector<double>& limits : map.limits) {
      for (std::size_t i = 0; i < lowest.size(); ++i) lowest[i] = std::min(lowest[i], limits[i]);
    }
    for (std::vector<dvec2> piece : segments_of(map.damping, lowest)) {
      piece.emplace_back(piece.back().x, kPlot.bottom());
      piece.emplace_back(piece.front().x, kPlot.bottom());
      svg_.polygon(piece, kStableColour);
    }
  }

  void curve(const std::vector<double>& damping, const std::vector<double>& limits, const base::Pen& pen) {
    for (const std::vector<dvec2>& piece : segments_of(damping, limits)) svg_.polyline(piece, pen);
  }

  void point(double damping, const char* colour) {
    svg_.dot({x(damping), y(wanted_)}, 1.3, colour);
    svg_.ring({x(damping), y(wanted_)}, 2.2, {colour, 0.4});
  }

  void frame() { svg_.frame(kPlot, "none", {base::kSoftInk, 0.3}); }

 private:
  void include_stiffness(double stiffness) {
    if (stiffness <= 0.0 || std::isinf(stiffness)) return;
    lowest_ = std::min(lowest_, stiffness);
    highest_ = std::max(highest_, stiffness);
  }

  double x(double damping) const { return kPlot.x + kPlot.width * damping / end_; }
  double y(double stiffness) const {
    const double fraction = (std::log10(stiffness) - low_) / (high_ - low_);
    return kPlot.bottom() - kPlot.height * std::clamp(fraction, 0.0, 1.0);
  }
  double bottom() const { return std::pow(10.0, low_); }

  void k_line(double stiffness, bool decade) {
    if (stiffness > 1.001 * std::pow(10.0, high_)) return;
    svg_.line({kPlot.x, y(stiffness)}, {kPlot.right(), y(stiffness)}, {base::kGridInk, decade ? 0.3 : 0.12});
    svg_.text({kPlot.x - 3.2, y(stiffness) + 0.9}, {decade ? 2.6 : 2.2, decade ? base::kInk : base::kSoftInk, "end"},
              grouped(stiffness));
  }
  void b_line(double damping) {
    svg_.line({x(damping), kPlot.y}, {x(damping), kPlot.bottom()}, {base::kGridInk, 0.12});
    svg_.text({x(damping), kPlot.bottom() + 4.2}, {2.6, base::kInk, "middle"}, grouped(damping));
  }

  // The parts of a curve above the bottom of the plot.
  std::vector<std::vector<dvec2>> segments_of(const std::vector<double>& damping,
                                              const std::vector<double>& limits) const {
    std::vector<std::vector<dvec2>> all;
    const auto crossing = [&](std::size_t in, std::size_t out) {
      const double inside = std::min(limits[in], 1e9);
      const double fraction = (inside - bottom()) / (inside - limits[out]);
      return dvec2(x(damping[in] + fraction * (damping[out] - damping[in])), kPlot.bottom());
    };
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const bool on_page = limits[i] > bottom(), was_on_page = i > 0 && limits[i - 1] > bottom();
      if (on_page && !was_on_page) all.emplace_back();
      if (on_page && !was_on_page && i > 0) all.back().push_back(crossing(i, i - 1));
      if (on_page) all.back().emplace_back(x(damping[i]), y(limits[i]));
      if (!on_page && was_on_page) all.back().push_back(crossing(i - 1, i));
    }
    return all;
  }

  base::Svg& svg_;
  double end_;                           // [N s/m] damping at the right edge
  double wanted_;                        // [N/m]
  double lowest_ = 1e9, highest_ = 1.0;  // [N/m] range of stiffness that the plot must include
  double low_ = 0.0, high_ = 1.0;        // log10 of the stiffness [N/m] at the bottom and the top of the plot
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
    svg_.dot(at_ + dvec2(3.0, 0.0), 1.3, colour);
    svg_.ring(at_ + dvec2(3.0, 0.0), 2.2, {colour, 0.4});
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
  plot.point(question.wall.damping, answer.may_use ? base::kInk : base::kLockoutColour);
  draw_legend(svg, question, answer);
  return std::move(svg).finish();
}

}  // namespace gearshift::lab
