// Decides how much haptic guidance the next trial gets.
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

#include "app/lessons/assessment/hint_style.h"

namespace gearshift::lessons {

// All defaults are engineering values.
struct GuidanceConfig {
  double start = 1.0;               // [1] guidance gain of a beginner
  double forgetting = 0.9;          // [1] f of a beginner: fraction of the gain left after a trial
  double forgetting_skilled = 0.6;  // [1] f of a skilled learner, to whom guidance does more harm
  // [1] run_error that counts as the worst possible trial: the most that a pass grade of 6 tolerates
  double full_error = 0.4;
  double per_error = 0.2;       // [1] k: gain added by a worst possible trial
  double min_gain = 0.05;       // [1] smaller gains are treated as 0
  double skill_memory = 0.7;    // [1] weight of the old skill estimate after a trial
  double bandwidth_from = 0.4;  // [1] from this skill on, feedback only on errors
  double summary_from = 0.75;   // [1] from this skill on, feedback only at the end
};

// After a pause of this length, which includes a night, a trial measures retention. Engineering value.
inline constexpr std::int64_t kRetentionPause = std::int64_t{20} * 3600;  // [s]

struct TrialPlan {
  double guidance = 0.0;  // [1] 0 to 1 for DriverControls and LessonRunConfig; 0: the trial is graded
  HintStyle hints = HintStyle::prescriptive;
};

// After each trial, guided or not, the gain g becomes clamp(f g + k e, 0, 1), with e = min(1, error / full_error) and f
// falling from forgetting to forgetting_skilled as skill grows. Two of every four trials are unguided, in an order
// drawn from the seed. The same seed and errors give the same plans.
class GuidancePolicy {
 public:
  explicit GuidancePolicy(std::uint64_t seed, const GuidanceConfig& config = {});

  TrialPlan next();
  TrialPlan retention() const noexcept;  // a test after a day or a week: no guidance, no feedback in the drive
  void learn(double error) noexcept;     // error: run_error() of the trial just driven

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

}  // namespace gearshift::lessons
