#include "app/lessons/simulated_driver/learning_experiment.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/guidance.h"
#include "haptics/device/gaussian_noise.h"

namespace gearshift::lessons {
namespace {

constexpr int kRetentionTrials = 2;
constexpr double kNormal95 = 1.959964;  // [1] 97.5 % quantile of the normal distribution

// Random numbers that are equal on all platforms. Does not use std::uniform_real_distribution: the C++ standard defines
// the numbers of std::mt19937_64, but not those of the distributions.
class RandomSource {
 public:
  explicit RandomSource(std::uint64_t seed) : engine_(seed), noise_(seed + 1) {}
  double between(double low, double high) noexcept {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  double normal() noexcept { return noise_.next(); }
  std::uint64_t seed() noexcept { return engine_(); }

 private:
  std::mt19937_64 engine_;
  haptics::GaussianNoise noise_;
};

LessonResult drive_as(LessonDriveConfig drive, double error, double guidance, std::uint64_t seed) {
  drive.skill = skill_of(error);
  drive.guidance = guidance;
  drive.seed = seed;
  return drive_lesson(drive);
}

bool is_reported(const LessonResult& result, ErrorKind kind) {
  return std::any_of(result.errors.begin(), result.errors.end(),
                     [&](const DrivingError& error) { return error.kind == kind && error.severity != Severity::note; });
}

// Returns the grade. An unfinished lesson scores 0, even if it contains no errors.
double score(const LessonResult& result) noexcept {
  return result.end == LessonEnd::done ? result.grade : 0.0;
}

// 97.5 % quantile of Student's distribution: the expansion by Fisher and Cornish (Abramowitz, Stegun. Handbook of
// Mathematical Functions. 1964, 26.7.5). Its error is below 0.2 % from 9 degrees of freedom on.
double student_95(double freedom) noexcept {
  const double z = kNormal95, z2 = z * z;
  const double first = z * (z2 + 1.0) / 4.0, second = z * (5.0 * z2 * z2 + 16.0 * z2 + 3.0) / 96.0;
  const double third = z * (3.0 * z2 * z2 * z2 + 19.0 * z2 * z2 + 17.0 * z2 - 15.0) / 384.0;
  return z + first / freedom + second / (freedom * freedom) + third / (freedom * freedom * freedom);
}

// One simulated driver during a sequence of trials.
struct Trainee {
  double error, rate;
  GuidancePolicy policy;
  int guided = 0;

  TrialPlan plan(Practice practice) {
    TrialPlan plan = policy.next();
    if (practice == Practice::unguided) plan.guidance = plan.pedal_help = 0.0;
    if (practice == Practice::always) plan.guidance = plan.pedal_help = 1.0;
    return plan;
  }

  void learn(const LearningModel& model, Practice practice, const LessonResult& result, const Norm* norm,
             const TrialPlan& plan) {
    const double failed = run_error(result), help = 0.5 * (plan.guidance + plan.pedal_help);
    error *= 1.0 - rate * (1.0 - model.guided_loss * help) * (1.0 - model.failed_loss * failed);
    const double lever = lever_error(result, norm), pedals = pedal_error(result, norm), worse = std::max(lever, pedals);
    practice == Practice::both_limbs ? policy.learn(failed, worse, worse) : policy.learn(failed, lever, pedals);
    if (help > 0.0) ++guided;
  }
};

}  // namespace

double roc_auc(std::span<const double> skilled, std::span<const double> unskilled) noexcept {
  if (skilled.empty() || unskilled.empty()) return 0.5;
  double wins = 0.0;
  for (const double good : skilled) {
    for (const double bad : unskilled) wins += good > bad ? 1.0 : good == bad ? 0.5 : 0.0;
  }
  return wins / static_cast<double>(skilled.size() * unskilled.size());
}

IntervalEstimate auc_estimate(std::span<const double> skilled, std::span<const double> unskilled) noexcept {
  const double auc = roc_auc(skilled, unskilled);
  const auto m = static_cast<double>(skilled.size()), n = static_cast<double>(unskilled.size());
  if (m == 0.0 || n == 0.0) return {auc, 0.0, 1.0};
  const double half = 0.5 * (m + n) - 1.0;
  // Hanley and McNeil's standard error for a true value `t`, with equal class sizes.
  const auto deviation = [&](double t) {
    return std::sqrt(t * (1.0 - t) * (1.0 + half * ((1.0 - t) / (2.0 - t) + t / (1.0 + t))) / (m * n));
  };
  // The limits are the true values from which `auc` lies kNormal95 standard errors away.
  const auto limit = [&](double inside, double outside) {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (std::abs(auc - middle) <= kNormal95 * deviation(middle) ? inside : outside) = middle;
    }
    return inside;
  };
  return {auc, limit(auc, 0.0), limit(auc, 1.0)};
}

IntervalEstimate paired_difference(std::span<const double> with, std::span<const double> without) noexcept {
  const auto n = static_cast<double>(with.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i) sum += with[i] - without[i];
  const double centre = sum / n;
  for (std::size_t i = 0; i < with.size(); ++i) {
    const double off = with[i] - without[i] - centre;
    squares += off * off;
  }
  const double half = student_95(n - 1.0) * std::sqrt(squares / (n - 1.0) / n);
  return {centre, centre - half, centre + half};
}

IntervalEstimate fraction_estimate(int successes, int trials) noexcept {
  const double n = trials, p = successes / n, z2 = kNormal95 * kNormal95;
  const double centre = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = kNormal95 * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  return {p, std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

ErrorSeparation separate_error(const LessonDriveConfig& drive, ErrorKind kind, int each, std::uint64_t seed) {
  RandomSource random(seed);
  ErrorSeparation result;
  std::vector<double> without, with;
  LessonDriveConfig faulty = drive;
  for (int i = 0; i < each; ++i) {
    const double error = random.between(0.0, kMaxSkilledError);
    faulty.errors = deliberate_error(kind, random.between(0.6, 1.4));
    const LessonResult good = drive_as(drive, error, 0.0, random.seed());
    const LessonResult bad = drive_as(faulty, error, 0.0, random.seed());
    without.push_back(score(good));
    with.push_back(score(bad));
    result.detected += is_reported(bad, kind) ? 1 : 0;
    result.false_alarms += is_reported(good, kind) ? 1 : 0;
  }
  result.driven = each;
  result.auc = roc_auc(without, with);
  return result;
}

PracticeOutcome practise(const LessonDriveConfig& drive, Practice practice, const LearningModel& model, int learners,
                         int trials, std::uint64_t seed) {
  PracticeOutcome outcome;
  outcome.error.assign(static_cast<std::size_t>(trials) + 1, 0.0);
  const Norm* norm = norm_of(drive.lesson, drive.mode, drive.car, driven_gate(drive.gate));
  int guided = 0, early = 0;
  for (int i = 0; i < learners; ++i) {
    RandomSource random(seed + static_cast<std::uint64_t>(i));  // the same drivers in every kind of practice
    const double start = random.between(model.min_start_error, 1.0);
    const double rate = std::min(1.0, model.rate * std::exp(model.rate_spread * random.normal()));
    Trainee trainee{start, rate, GuidancePolicy(random.seed())};
    outcome.error[0] += trainee.error / learners;
    for (int trial = 1; trial <= trials; ++trial) {
      const TrialPlan plan = trainee.plan(practice);
      const int before = trainee.guided;
      trainee.learn(model, practice, drive_as(drive, trainee.error, plan.guidance, random.seed()), norm, plan);
      if (2 * trial <= trials) early += trainee.guided - before;
      outcome.error[static_cast<std::size_t>(trial)] += trainee.error / learners;
    }
    double failed = 0.0;
    for (int test = 0; test < kRetentionTrials; ++test)
      failed += run_error(drive_as(drive, trainee.error, 0.0, random.seed())) / kRetentionTrials;
    outcome.test_error.push_back(failed);
    guided += trainee.guided;
  }
  outcome.guided_fraction = static_cast<double>(guided) / (static_cast<double>(learners) * trials);
  const int first_half = trials / 2;
  outcome.guided_early = static_cast<double>(early) / (static_cast<double>(learners) * first_half);
  return outcome;
}

}  // namespace gearshift::lessons
