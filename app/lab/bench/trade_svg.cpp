#include "app/lab/bench/trade_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/base/chart.h"
#include "app/base/colours.h"
#include "app/base/svg.h"
#include "app/lab/bench/pareto.h"

namespace gearshift::lab {
namespace {

constexpr int kColumns = 2;
constexpr double kPanelWidth = 480.0, kPlotHeight = 230.0;  // [px]
constexpr double kLeft = 64.0, kRight = 24.0, kTop = 54.0, kBelow = 50.0, kLine = 18.0;
// [px] kNames: distance from the left edge to the method names. kCostColumn: distance from the right edge to the end of
// the costs.
constexpr double kNames = 30.0, kCostColumn = 104.0;
constexpr double kDot = 4.5, kNumber = 11.0, kCap = 3.5;  // [px]
constexpr const char* kBeaten = "#a9b4bf";
constexpr const char* kOnFront = base::kInk;
constexpr const char* kChosen = base::kGearColour;

using Contest = std::vector<const Trade*>;

std::vector<Contest> contests_of(std::string_view family, const std::vector<BenchRow>& rows) {
  std::vector<Contest> contests;
  for (const BenchRow& row : rows) {
    if (row.family != family || !row.trade || !row.measured) continue;
    const auto same = [&](const Contest& c) { return c.front()->contest == row.trade->contest; };
    auto contest = std::find_if(contests.begin(), contests.end(), same);
    if (contest == contests.end()) contest = contests.insert(contests.end(), Contest{});
    contest->push_back(&*row.trade);
  }
  // A contest with a single method has nothing to compare.
  std::erase_if(contests, [](const Contest& contest) { return contest.size() < 2; });
  return contests;
}

bool is_plottable(const Trade& trade) {
  return std::isfinite(trade.cost.value) && std::isfinite(trade.error.value);
}

bool has_bar(const RelatedFigure& figure) {
  return figure.spread && std::isfinite(figure.spread->low) && std::isfinite(figure.spread->high);
}

std::string figure_text(double value) {
  return std::abs(value) >= 1000.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string name_of(const Trade& trade) {
  return trade.method + (trade.chosen ? " (the default)" : "") + (is_plottable(trade) ? "" : ", not in the plot");
}

std::string axis_name(const RelatedFigure& figure) {
  return figure.unit.empty() ? figure.what : fmt::format("{}, {}", figure.what, figure.unit);
}

std::vector<double> all_of(const Contest& contest, const RelatedFigure Trade::*figure) {
  std::vector<double> values;
  for (const Trade* trade : contest) {
    const RelatedFigure& shown = trade->*figure;
    values.push_back(shown.value);
    if (shown.spread) values.insert(values.end(), {shown.spread->low, shown.spread->high});
  }
  return values;
}

class Panel {
 public:
  Panel(base::Svg& svg, glm::dvec2 corner, const Contest& contest)
      : svg_(svg),
        corner_(corner),
        box_{corner.x + kLeft, corner.y + kTop, kPanelWidth - kLeft - kRight, kPlotHeight},
        contest_(contest),
        chart_(svg, box_, base::Scale::decades_around(all_of(contest, &Trade::cost)),
               base::Scale::decades_around(all_of(contest, &Trade::error))) {
    std::vector<glm::dvec2> points;
    for (const Trade* trade : contest) points.emplace_back(trade->cost.value, trade->error.value);
    front_ = pareto_front(points);
  }

  void draw() {
    svg_.text(corner_ + glm::dvec2(kNames, 18.0), {14.0, base::kInk, "start", true}, contest_.front()->contest);
    grid();
    front_line();
    for (std::size_t i = 0; i < contest_.size(); ++i)
      if (is_plottable(*contest_[i])) dot(i);
    for (std::size_t i = 0; i < contest_.size(); ++i)
      if (is_plottable(*contest_[i])) number(i);
    names();
  }

 private:
  glm::dvec2 at(const Trade& trade) const { return chart_.at(trade.cost.value, trade.error.value); }
  bool on_front(std::size_t i) const { return std::find(front_.begin(), front_.end(), i) != front_.end(); }
  const char* colour_of(std::size_t i) const {
    return contest_[i]->chosen ? kChosen : on_front(i) ? kOnFront : kBeaten;
  }

  void grid() {
    svg_.frame(box_, "none", {base::kGridInk, 1.0});
    chart_.x_grid();
    chart_.y_grid();
    chart_.x_name(axis_name(contest_.front()->cost));
    chart_.y_name(axis_name(contest_.front()->error));
  }

  // Draws the front as steps: at each cost, the line shows the error of the best method that costs no more.
  void front_line() {
    std::vector<glm::dvec2> line;
    for (const std::size_t i : front_) {
      const glm::dvec2 here = at(*contest_[i]);
      line.push_back(line.empty() ? glm::dvec2(here.x, box_.y) : glm::dvec2(here.x, line.back().y));
      line.push_back(here);
    }
    if (line.empty()) return;
    line.emplace_back(box_.right(), line.back().y);
    svg_.polyline(line, {base::kSoftInk, 1.4});
  }

  // Draws an error bar. Its end caps distinguish it from the front line, which may coincide with the bar.
  void bar(glm::dvec2 from, glm::dvec2 to, glm::dvec2 cap, const base::Pen& pen) {
    svg_.line(from, to, pen);
    svg_.line(from - cap, from + cap, pen);
    svg_.line(to - cap, to + cap, pen);
  }

  void dot(std::size_t i) {
    const Trade& trade = *contest_[i];
    const base::Pen pen{colour_of(i), 1.2};
    if (has_bar(trade.cost))
      bar(chart_.at(trade.cost.spread->low, trade.error.value), chart_.at(trade.cost.spread->high, trade.error.value),
          {0.0, kCap}, pen);
    if (has_bar(trade.error))
      bar(chart_.at(trade.cost.value, trade.error.spread->low), chart_.at(trade.cost.value, trade.error.spread->high),
          {kCap, 0.0}, pen);
    svg_.dot(at(trade), kDot, colour_of(i), trade.method);
    if (trade.chosen) svg_.ring(at(trade), kDot + 3.0, {kChosen, 1.6});
  }

  // Places a method's number next to its dot, away from other dots and numbers.
  void number(std::size_t i) {
    const glm::dvec2 dot = at(*contest_[i]);
    constexpr std::array<glm::dvec2, 8> kPlaces{
        {{12, -9}, {12, 12}, {-12, -9}, {-12, 12}, {0, -15}, {0, 16}, {17, 2}, {-17, 2}}};
    glm::dvec2 best = dot + kPlaces[0];
    double best_clearance = -1.0;
    for (const glm::dvec2 place : kPlaces) {
      const double distance = clearance(dot + place, i);
      if (distance > best_clearance + 2.0) best_clearance = distance, best = dot + place;
    }
    numbers_.push_back(best);
    svg_.text(best + glm::dvec2(0.0, 4.0), {kNumber, base::kInk, "middle", contest_[i]->chosen}, std::to_string(i + 1));
  }

  // [px] Distance to the nearest other dot or number, at most kEnough; halved near the plot's edge and outside it.
  double clearance(glm::dvec2 place, std::size_t index) const {
    constexpr double kEnough = 14.0;
    double nearest = kEnough;
    for (std::size_t i = 0; i < contest_.size(); ++i) {
      if (i != index && is_plottable(*contest_[i])) nearest = std::min(nearest, glm::distance(place, at(*contest_[i])));
    }
    for (const glm::dvec2 number : numbers_) nearest = std::min(nearest, glm::distance(place, number));
    const bool outside = place.x < box_.x + 6.0 || place.x > box_.right() - 6.0 || place.y < box_.y + 6.0 ||
                         place.y > box_.bottom() - 6.0;
    return outside ? 0.5 * nearest : nearest;
  }

  void names() {
    double y = box_.bottom() + kBelow + 8.0;
    const base::Type heading{11.0, base::kSoftInk, "end"};
    svg_.text({corner_.x + kPanelWidth - kCostColumn, y}, heading, "cost");
    svg_.text({corner_.x + kPanelWidth - kRight, y}, heading, "error");
    y += kLine;
    for (std::size_t i = 0; i < contest_.size(); ++i, y += kLine) {
      const Trade& trade = *contest_[i];
      const char* ink = trade.chosen ? kChosen : on_front(i) ? base::kInk : base::kSoftInk;
      svg_.text({corner_.x + 20.0, y}, {12.0, ink, "end", trade.chosen}, std::to_string(i + 1));
      svg_.text({corner_.x + kNames, y}, {12.0, ink, "start", trade.chosen}, name_of(trade));
      svg_.text({corner_.x + kPanelWidth - kCostColumn, y}, {12.0, ink, "end"}, figure_text(trade.cost.value));
      svg_.text({corner_.x + kPanelWidth - kRight, y}, {12.0, ink, "end"}, figure_text(trade.error.value));
    }
  }

  base::Svg& svg_;
  glm::dvec2 corner_;
  base::Rect box_;
  const Contest& contest_;
  base::Chart chart_;
  std::vector<std::size_t> front_;
  std::vector<glm::dvec2> numbers_;
};

double height_of(const Contest& contest) {
  return kTop + kPlotHeight + kBelow + kLine * static_cast<double>(contest.size() + 1) + 20.0;
}

}  // namespace

std::string trade_svg(std::string_view family, const std::vector<BenchRow>& rows) {
  const std::vector<Contest> contests = contests_of(family, rows);
  if (contests.empty()) return {};
  std::vector<glm::dvec2> corners;
  double y = 0.0;
  for (std::size_t first = 0; first < contests.size(); first += kColumns) {
    double height = 0.0;
    for (std::size_t i = first; i < std::min(contests.size(), first + kColumns); ++i) {
      corners.emplace_back(kPanelWidth * static_cast<double>(i - first), y);
      height = std::max(height, height_of(contests[i]));
    }
    y += height;
  }
  base::Svg svg({0.0, 0.0, kPanelWidth * static_cast<double>(std::min<std::size_t>(kColumns, contests.size())), y},
                1.0);
  for (std::size_t i = 0; i < contests.size(); ++i) Panel(svg, corners[i], contests[i]).draw();
  return std::move(svg).finish();
}

}  // namespace gearshift::lab
