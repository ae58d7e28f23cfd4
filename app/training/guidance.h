// How much help the next trial gets.
//
// This work is based on:
// Jeremy L. Emken, Raul Benitez, David J. Reinkensmeyer. Human-robot cooperative movement training: learning a novel
// sensory motor transformation during walking with robotic assistance-as-needed. 2007 (gain = forgetting x gain + k error)
// Laura Marchal-Crespo, Sarah McHughen, Steven C. Cramer, David J. Reinkensmeyer. The effect of haptic guidance, aging,
// and initial skill level on motor learning of a steering task. 2010
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/training/hint_style.h"

namespace gearshift {

// [engineering value]s throughout.
struct GuidanceConfig {
  double start = 1.0;           // [1] gain of a beginner
  double forget = 0.9;          // [1] f of a beginner: share of the gain that is left after a trial
  double forget_skilled = 0.6;  // [1] and of a skilled learner, in whom guidance does more harm
  double full_error = 0.4;      // [1] run_error from which a trial is as bad as can be: what a pass grade of 6 forgives
  double per_error = 0.2;       // [1] k: gain for such a trial
  double least = 0.05;          // [1] less is none
  double skill_memory = 0.7;    // [1] share of the old estimate of skill that is kept after a trial
  double bandwidth_from = 0.4;  // [1] skill, from here on only faults are said
  double summary_from = 0.75;   // [1] and from here on at the end
};

// From so long a pause on a trial shows what was kept: a night lies between. [engineering value]
inline constexpr std::int64_t kRetentionPause = std::int64_t{20} * 3600;  // [s]

struct TrialPlan {
  double guidance = 0.0;  // [1] 0 to 1 for DriverControls and LessonRunConfig; 0: the trial is graded
  HintStyle hints = HintStyle::prescriptive;
};

// After each trial, guided or not, g <- clamp(f g + k e, 0, 1), e = min(1, error / full_error), f falling from forget to
// forget_skilled as skill grows. In each four trials two are unguided, in an order drawn from the seed. Pure: the same seed and errors give the
// same plans.
class GuidancePolicy {
 public:
  explicit GuidancePolicy(std::uint64_t seed, const GuidanceConfig& config = {});

  TrialPlan next();
  TrialPlan retention() const noexcept;  // a test a day or a week later: no guidance, nothing said on the way
  void learn(double error) noexcept;     // [1] 0 to 1 of the trial that was driven: run_error

  double gain() const noexcept { return gain_; }    // [1]
  double skill() const noexcept { return skill_; }  // [1] running mean of 1 - e

 private:
  void shuffle() noexcept;

  GuidanceConfig config_;
  std::uint64_t random_;
  double gain_;
  double skill_ = 0.0;
  std::array<bool, 4> guided_{true, true, false, false};
  std::size_t trial_ = 0;
};

}  // namespace gearshift
