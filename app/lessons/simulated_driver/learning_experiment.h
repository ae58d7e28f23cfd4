// Experiments with many simulated drivers, and their statistics. Are errors detected? How does a guidance policy affect
// learning?
//
// Each trial is driven in full by a simulated driver. Only the improvement from trial to trial is a model
// (LearningModel).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::lessons {

// Area under the ROC curve: the probability that a random skilled driver has a better grade than a random unskilled
// driver. Ties count half. Equals Mann and Whitney's U divided by the number of pairs. 0.5 if a class is empty.
double roc_auc(std::span<const double> skilled, std::span<const double> unskilled) noexcept;

// A figure with its 95 % interval.
struct IntervalEstimate {
  double value = 0.0, low = 0.0, high = 0.0;
};
// Interval of roc_auc() after R. G. Newcombe. Confidence intervals for an effect size measure based on the Mann-Whitney
// statistic. Part 2. 2006 (method 5). Unlike DeLong's and the bootstrap, it has a width where the classes do not overlap.
IntervalEstimate auc_estimate(std::span<const double> skilled, std::span<const double> unskilled) noexcept;
// Mean of `with` minus `without`, paired by index, with Student's interval; both have the same size, at least 2.
IntervalEstimate paired_difference(std::span<const double> with, std::span<const double> without) noexcept;
// `successes` of `trials` as a fraction [1], with Wilson's interval. trials > 0.
IntervalEstimate fraction_estimate(int successes, int trials) noexcept;

// Skill errors (see skill_of()) of skilled drivers are uniform from 0 to this value [1]. Engineering value.
inline constexpr double kMaxSkilledError = 0.15;

// Compares practised drivers who make one kind of deliberate error with practised drivers who make none. The error's
// amount is uniformly distributed from 0.6 to 1.4.
struct ErrorSeparation {
  int driven = 0;
  int detected = 0;      // drives with the deliberate error in which it was reported
  int false_alarms = 0;  // drives without the deliberate error in which it was reported
  double auc = 0.5;
};
ErrorSeparation separate_error(const LessonDriveConfig& drive, ErrorKind kind, int each, std::uint64_t seed);

// After each trial, with help g, the mean of both limbs' gains, and run_error() of grade.h, the skill error e becomes
//     e (1 - rate (1 - guided_loss g) (1 - failed_loss run_error)).
//
// Learning is exponential in the number of trials (Heathcote, Brown, Mewhort 2000). A guided trial teaches less than an
// unguided one (guidance hypothesis: Salmoni, Schmidt, Walter 1984; Winstein, Pohl, Lewthwaite 1994). A failed trial
// teaches less than a successful one, because too hard a task leaves little to learn from (Guadagnoli, Lee 2004). How
// much less is an engineering value: there is no source for gear shifting.
struct LearningModel {
  double rate = 0.12;            // [1] fraction of the skill error that a perfect unguided trial removes
  double guided_loss = 0.7;      // [1] fraction of the learning that is lost at full guidance
  double failed_loss = 0.5;      // [1] fraction of the learning that is lost in a completely failed trial
  double rate_spread = 0.3;      // [1] relative standard deviation between learners
  double min_start_error = 0.7;  // [1] initial skill errors are uniform from this value to 1
};

// always: full help for both limbs. by_limb: by GuidancePolicy. both_limbs: by GuidancePolicy, but help for both limbs
// after errors of either.
enum class Practice { unguided, always, both_limbs, by_limb };

struct PracticeOutcome {
  std::vector<double> error;       // [1] mean skill error before the first trial and after each one
  std::vector<double> test_error;  // [1] of each learner: mean run_error() of the final unguided tests
  double guided_fraction = 0.0;    // [1] fraction of trials with help
  double guided_early = 0.0;       // [1] the same in the first half
};

// Each driver drives `trials` trials of the lesson, then two unguided tests. The tests do not count for learning.
PracticeOutcome practise(const LessonDriveConfig& drive, Practice practice, const LearningModel& model, int learners,
                         int trials, std::uint64_t seed);

}  // namespace gearshift::lessons
