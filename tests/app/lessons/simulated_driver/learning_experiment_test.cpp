// Populations of simulated drivers: how well grades separate skilled from unskilled drivers, and how the learning model
// behaves.
#include "app/lessons/simulated_driver/learning_experiment.h"

#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "tests/app/lessons/simulated_driver/lessons.h"

using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

// The area under the ROC curve, computed by lowering the grade threshold step by step and adding trapezoids.
double area_by_threshold(const std::vector<double>& good, const std::vector<double>& bad) {
  std::vector<double> thresholds(good);
  thresholds.insert(thresholds.end(), bad.begin(), bad.end());
  std::sort(thresholds.rbegin(), thresholds.rend());
  const auto fraction_above = [](const std::vector<double>& values, double threshold) {
    return static_cast<double>(std::count_if(values.begin(), values.end(), [&](double v) { return v >= threshold; })) /
           static_cast<double>(values.size());
  };
  double area = 0.0, x = 0.0, y = 0.0;
  for (const double t : thresholds) {
    area += 0.5 * (fraction_above(good, t) + y) * (fraction_above(bad, t) - x);
    x = fraction_above(bad, t), y = fraction_above(good, t);
  }
  return area;
}

// Standard deviation of the AUC after E. DeLong, D. DeLong, Clarke-Pearson. Comparing the areas under two or more
// correlated receiver operating characteristic curves. 1988.
double delong_deviation(const std::vector<double>& good, const std::vector<double>& bad) {
  const auto variance_of_wins = [](const std::vector<double>& own, const std::vector<double>& others, bool is_good) {
    std::vector<double> wins;
    for (const double x : own) {
      double sum = 0.0;
      for (const double y : others) sum += x == y ? 0.5 : (x > y) == is_good ? 1.0 : 0.0;
      wins.push_back(sum / static_cast<double>(others.size()));
    }
    double mean = 0.0, variance = 0.0;
    for (const double w : wins) mean += w / static_cast<double>(wins.size());
    for (const double w : wins) variance += (w - mean) * (w - mean) / static_cast<double>(wins.size() - 1);
    return variance / static_cast<double>(wins.size());
  };
  return std::sqrt(variance_of_wins(good, bad, true) + variance_of_wins(bad, good, false));
}

// A lesson that requires nothing and ends at once, so that all errors and all learning come from the model.
LessonDriveConfig nothing_to_do() {
  LessonDriveConfig drive = shipped_drive("moving_off");
  drive.lesson.steps.resize(1);
  return drive;
}

}  // namespace

TEST_CASE("the AUC equals the area under the ROC curve, also with ties") {
  const std::vector<double> good{10, 9.5, 9.5, 8, 10}, bad{9.5, 6, 8, 10};
  CHECK(roc_auc(good, bad) == doctest::Approx(area_by_threshold(good, bad)));
  CHECK(roc_auc(bad, good) == doctest::Approx(1.0 - roc_auc(good, bad)));
  CHECK(roc_auc(std::vector{2.0, 3.0}, std::vector{0.0, 1.0}) == 1.0);
  CHECK(roc_auc(good, good) == doctest::Approx(0.5));
  CHECK(roc_auc({}, bad) == 0.5);
}

TEST_CASE("the interval of the AUC agrees with DeLong's for many drivers, and has a width without overlap") {
  std::mt19937_64 random(3);
  const auto normals = [&](double mean) {
    std::vector<double> values;
    for (int i = 0; i < 400; ++i) {
      double sum = mean - 6.0;  // the sum of twelve uniform numbers has the variance 1
      for (int k = 0; k < 12; ++k) sum += static_cast<double>(random() >> 11) * 0x1.0p-53;
      values.push_back(sum);
    }
    return values;
  };
  const std::vector<double> good = normals(1.0), bad = normals(0.0);
  const IntervalEstimate estimate = auc_estimate(good, bad);
  // Normal distributions one deviation apart: AUC = Phi(1 / sqrt 2) = 0.760.
  CHECK(estimate.low < 0.760);
  CHECK(estimate.high > 0.760);
  const double half = 1.96 * delong_deviation(good, bad);
  CHECK(estimate.low == doctest::Approx(estimate.value - half).epsilon(0.01));
  CHECK(estimate.high == doctest::Approx(estimate.value + half).epsilon(0.01));
  const IntervalEstimate apart = auc_estimate(std::vector<double>(20, 1.0), std::vector<double>(20, 0.0));
  CHECK(apart.value == 1.0);
  CHECK(apart.high == doctest::Approx(1.0));
  CHECK(apart.low > 0.8);
  CHECK(apart.low < 0.97);
}

TEST_CASE("Wilson's interval of a fraction") {
  // Newcombe. Two-sided confidence intervals for the single proportion. 1998, table I: 81 of 263 and 0 of 20.
  const IntervalEstimate some = fraction_estimate(81, 263), none = fraction_estimate(0, 20);
  CHECK(some.low == doctest::Approx(0.2553).epsilon(1e-3));
  CHECK(some.high == doctest::Approx(0.3662).epsilon(1e-3));
  CHECK(none.low == doctest::Approx(0.0));
  CHECK(none.high == doctest::Approx(0.1611).epsilon(1e-3));
}

TEST_CASE("a deliberate error is detected and lowers the grade, and is not detected in other drives") {
  for (const ErrorKind kind : {ErrorKind::clutch_late, ErrorKind::wrong_column, ErrorKind::over_rev}) {
    const ErrorSeparation s = separate_error(shipped_drive("skip_shifts"), kind, 5, 3);
    CAPTURE(to_string(kind));
    CHECK(s.detected == s.driven);
    CHECK(s.false_alarms <= 1);
    CHECK(s.auc > 0.7);
  }
}

TEST_CASE("practice without failures follows e (1 - rate)^n, and guidance slows it by the model's loss") {
  LearningModel model;
  model.rate_spread = 0.0;
  model.min_start_error = 1.0;
  const LessonDriveConfig drive = nothing_to_do();
  const PracticeOutcome unguided = practise(drive, Practice::unguided, model, 2, 10, 1);
  const PracticeOutcome guided_always = practise(drive, Practice::always, model, 2, 10, 1);
  const PracticeOutcome by_limb = practise(drive, Practice::by_limb, model, 2, 10, 1);
  CHECK(unguided.error[0] == 1.0);
  CHECK(unguided.error[10] == doctest::Approx(std::pow(1.0 - model.rate, 10)));
  CHECK(guided_always.error[10] == doctest::Approx(std::pow(1.0 - model.rate * (1.0 - model.guided_loss), 10)));
  CHECK(unguided.guided_fraction == 0.0);
  CHECK(guided_always.guided_fraction == 1.0);
  CHECK(by_limb.guided_fraction == 0.0);  // nothing fails, so nothing helps
  CHECK(by_limb.error[10] == unguided.error[10]);
  CHECK(by_limb.test_error == std::vector<double>{0.0, 0.0});
}

TEST_CASE("a paired difference has Student's interval") {
  // Student 1908, extra hours of sleep by two drugs: mean 1.58, 95 % interval 0.70 to 2.46 (R: t.test(sleep)).
  const std::vector<double> second{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4},
      first{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
  const IntervalEstimate more = paired_difference(second, first);
  CHECK(more.value == doctest::Approx(1.58));
  CHECK(more.low == doctest::Approx(0.7001142).epsilon(0.003));
  CHECK(more.high == doctest::Approx(2.4598858).epsilon(0.003));
}

TEST_CASE("a trial with errors all the time teaches less, by the model's loss") {
  LearningModel model;
  model.rate_spread = 0.0;
  model.min_start_error = 1.0;
  LessonDriveConfig drive = nothing_to_do();
  drive.lesson.steps[0].until.speed_above = 40.0;
  drive.lesson.steps[0].until.clutch_above.reset();
  drive.lesson.time_limit = 1.0;
  const PracticeOutcome outcome = practise(drive, Practice::unguided, model, 1, 5, 1);
  CHECK(outcome.error[5] == doctest::Approx(std::pow(1.0 - model.rate * (1.0 - model.failed_loss), 5)));
}
