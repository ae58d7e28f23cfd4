#include "app/lessons/report/learning_svg.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/base/chart.h"
#include "app/base/colours.h"
#include "app/lessons/report/curve_band.h"
#include "app/lessons/report/report_text.h"

namespace gearshift::lessons {
namespace {

// Sizes [px] on the page.
constexpr base::Rect kPage{0.0, 0.0, 480.0, 280.0};
constexpr base::Rect kBox{40.0, 28.0, 426.0, 206.0};

constexpr const char* kBandColour = "#dce8f5";
constexpr std::size_t kMinAxisTrials = 6;  // shortest axis, in number of trials
constexpr int kCurveSteps = 160;

class LearningPlot {
 public:
  LearningPlot(base::Svg& svg, const TaskProgress& task)
      : task_(task),
        svg_(svg),
        last_(static_cast<double>(std::max(kMinAxisTrials, task.trials.size()))),
        chart_(svg, kBox, {0.5, last_ + 0.5}, {0.0, kBestGrade}) {}

  void axes() {
    chart_.y_grid(2.0);
    chart_.x_grid(std::max(1.0, base::grid_step(last_, 10)));
    chart_.y_name("grade");
    chart_.x_name("graded run");
  }

  void band() {
    std::vector<glm::dvec2> edge, lower;
    for (int i = 0; i <= kCurveSteps; ++i) {
      const double width = kBandDeviations * curve_deviation(*task_.curve, task_.trials.size(), trial_at(i));
      edge.push_back(data(trial_at(i), task_.curve->at(trial_at(i)) + width));
      lower.push_back(data(trial_at(i), task_.curve->at(trial_at(i)) - width));
    }
    edge.insert(edge.end(), lower.rbegin(), lower.rend());
    chart_.area(edge, kBandColour);
  }

  void curve() {
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= kCurveSteps; ++i) points.push_back(data(trial_at(i), task_.curve->at(trial_at(i))));
    chart_.curve(points, {base::kGearColour, 2.0});
  }

  void trials() {
    const double radius = task_.trials.size() > 60 ? 2.0 : 4.0;
    for (std::size_t i = 0; i < task_.trials.size(); ++i) {
      const GradedTrial& trial = task_.trials[i];
      const glm::dvec2 point = data(static_cast<double>(i), trial.grade), place = chart_.at(point.x, point.y);
      const std::string after = trial.pause > 0.0 ? ", after " + format_pause(trial.pause) : std::string();
      const std::string tip =
          fmt::format("Run {}, {}: {:.1f}{}", trial.run, day_of(trial.begun_at), trial.grade, after);
      if (trial.pause > 0.0) svg_.ring(place, radius + 3.0, {base::kInk, 1.2});
      svg_.dot(place, radius, trial.passed ? base::kGearColour : "#ffffff", tip);
      if (!trial.passed) svg_.ring(place, radius, {base::kLockoutColour, 0.4 * radius});
    }
  }

 private:
  // Trial number (0 for the first trial) at point `step` of the drawn curve, which ends at the last trial.
  double trial_at(int step) const { return static_cast<double>(task_.trials.size() - 1) * step / kCurveSteps; }
  // `n` counts trials from 0, as the curve does; the axis counts from 1. Points outside the scale are drawn at its
  // edge.
  static glm::dvec2 data(double n, double grade) { return {n + 1.0, std::clamp(grade, 0.0, kBestGrade)}; }

  const TaskProgress& task_;
  base::Svg& svg_;
  double last_;
  base::Chart chart_;
};

}  // namespace

std::string learning_svg(const TaskProgress& task) {
  base::Svg svg(kPage, 1.0);
  LearningPlot plot(svg, task);
  if (task.curve) plot.band();
  plot.axes();
  if (task.curve) plot.curve();
  plot.trials();
  return std::move(svg).finish();
}

}  // namespace gearshift::lessons
