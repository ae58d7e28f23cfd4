// Experiments with many simulated drivers: does the grade separate good from bad drivers, and how does a guidance
// policy affect learning?
//
// Lessons are not modelled: each trial is driven in full. The only assumption is how a learner improves
// (LearningModel).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::lessons {

// Area under the ROC curve: the probability that a skilled driver has a better grade than an unskilled one, ties
// counting half (Mann and Whitney's U divided by the number of pairs). 0.5 if one class is empty.
double roc_auc(std::span<const double> skilled, std::span<const double> unskilled) noexcept;

// Skill errors (see skill_of()) of both classes: uniform from 0 to max_skilled_error, and from min_unskilled_error to
// 1. Engineering values.
struct SkillClasses {
  double max_skilled_error = 0.15;
  double min_unskilled_error = 0.6;
};

struct Separation {
  std::vector<double> skilled, unskilled;  // grades; 0 for a lesson that was not finished
  int skilled_passed = 0, unskilled_passed = 0;
  double auc = 0.5;
};

// `each` drivers per class drive the lesson once, unguided. Skill and seed of `drive` are overwritten.
Separation separate(const LessonDriveConfig& drive, int each, std::uint64_t seed, const SkillClasses& classes = {});

// Compares practised drivers who make one deliberate error, its amount uniform in 0.6 to 1.4, with others who do not.
struct ErrorSeparation {
  int driven = 0;
  int detected = 0;      // drives with the deliberate error in which the error was reported
  int false_alarms = 0;  // drives without the deliberate error in which the error was reported
  double auc = 0.5;
};
ErrorSeparation separate_error(const LessonDriveConfig& drive, ErrorKind kind, int each, std::uint64_t seed,
                               const SkillClasses& classes = {});

// After each trial, with guidance g, the skill error e becomes
//     e (1 - rate (1 - guided_loss g) (1 - failed_loss run_error))
//
// Learning is exponential in the number of trials (Heathcote, Brown, Mewhort 2000). A guided trial teaches less
// (guidance hypothesis: Salmoni, Schmidt, Walter 1984; Winstein, Pohl, Lewthwaite 1994), and so does a failed one
// (Guadagnoli, Lee 2004: too hard a task leaves little to learn from). How much less is an engineering value: there is
// no source for gear shifting.
struct LearningModel {
  double rate = 0.12;            // [1] fraction of the skill error that a perfect unguided trial removes
  double guided_loss = 0.7;      // [1] fraction of the learning that is lost at full guidance
  double failed_loss = 0.5;      // [1] fraction of the learning that is lost in a completely failed trial
  double rate_spread = 0.3;      // [1] relative standard deviation between learners
  double min_start_error = 0.7;  // [1] smallest skill error at the start; uniform from here to 1
};

enum class Practice { unguided, guided_always, faded };  // guided_always: at full strength; faded: by GuidancePolicy

struct PracticeOutcome {
  std::vector<double> error;     // [1] mean skill error before the first trial and after each one
  double retention_grade = 0.0;  // [1] mean of the unguided trials at the end: skill without help
  double guided_fraction = 0.0;  // [1] fraction of guided trials
  double guided_early = 0.0;     // [1] fraction of guided trials in the first half
};

// Each driver drives `trials` trials of the lesson, then two unguided tests. Only the trials count for learning.
PracticeOutcome practise(const LessonDriveConfig& drive, Practice practice, const LearningModel& model, int learners,
                         int trials, std::uint64_t seed);

}  // namespace gearshift::lessons
