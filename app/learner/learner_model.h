// Many simulated learners: does the grade tell who can drive, and what does a guidance policy do to learning?
//
// What is measured is the lesson: each trial is driven whole. What is assumed is how a person gets better, and that is
// LearningModel alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/learner/lesson_drive.h"

namespace gearshift {

// Area under the ROC curve: the chance that a skilled learner has the better grade of the two, ties counting half
// (Mann and Whitney's U over the number of pairs). 0.5 where one class is empty.
double roc_auc(std::span<const double> skilled, std::span<const double> unskilled) noexcept;

// Skill errors (skill_of) of both classes, drawn evenly. [engineering value]s
struct SkillClasses {
  double skilled_most = 0.15;
  double unskilled_least = 0.6;
};

struct Separation {
  std::vector<double> skilled, unskilled;  // grades; 0 for a lesson that was not done, also where it was given up
  int skilled_passed = 0, unskilled_passed = 0;
  double auc = 0.5;
};

// `each` learners per class drive the lesson once, unguided. drive: skill and seed are drawn here.
Separation separate(const LessonDriveConfig& drive, int each, std::uint64_t seed, const SkillClasses& classes = {});

// Practised learners with one fault, its amount drawn evenly from 0.6 to 1.4, against practised ones without.
struct FaultSeparation {
  int driven = 0;
  int named = 0;        // it was, of those who made it
  int false_named = 0;  // of those who did not
  double auc = 0.5;
};
FaultSeparation separate_fault(const LessonDriveConfig& drive, FaultKind kind, int each, std::uint64_t seed,
                               const SkillClasses& classes = {});

// e <- e (1 - rate (1 - guided_loss g) (1 - failed_loss run_error))
//
// Exponential in the trials that were practised (Heathcote, Brown, Mewhort 2000: individuals follow an exponential). A
// guided trial teaches less (guidance hypothesis: Salmoni, Schmidt, Walter 1984; Winstein, Pohl, Lewthwaite 1994), and
// so does one that goes wrong (Guadagnoli, Lee 2004: what is too hard leaves little to learn from). How much less is
// [engineering value]: no source has it for shifting.
struct LearningModel {
  double rate = 0.12;        // [1] of the error, unlearned in a whole trial by oneself
  double guided_loss = 0.7;  // [1] of it that guidance at full strength takes away
  double failed_loss = 0.5;  // [1] of it that a trial loses that went wrong all through
  double rate_spread = 0.3;  // [1] relative standard deviation between learners
  double start_least = 0.7;  // [1] skill error at the start: evenly from here to 1
};

enum class Practice { alone, led, faded };  // never guided, always at full strength, by GuidancePolicy

struct PracticeOutcome {
  std::vector<double> error;     // [1] mean skill error after each trial, from before the first
  double retention_grade = 0.0;  // [1] mean of unguided trials at the end: what a person can without help
  double guided_share = 0.0;     // [1] of the trials
  double guided_early = 0.0;     // [1] of their first half
};

// Each learner drives `trials` trials of the lesson, then two that are not guided, and learns from the former alone.
PracticeOutcome practise(const LessonDriveConfig& drive, Practice practice, const LearningModel& model, int learners,
                         int trials, std::uint64_t seed);

}  // namespace gearshift
