// Decides how much help the next trial gets, for each limb: the lever leads the hand; for the feet, the bite point is
// marked and heard, and a clutch that a key moves comes up more slowly.
//
// This work is based on:
// Jeremy L. Emken, Raul Benitez, David J. Reinkensmeyer. Human-robot cooperative movement training: learning a novel
// sensory motor transformation during walking with robotic assistance-as-needed. 2007
// (gain = forgetting x gain + k error)
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
  double start = 0.0;               // [1] gain of a beginner: help follows errors
  double forgetting = 0.9;          // [1] factor f that reduces a beginner's gain after each trial
  double forgetting_skilled = 0.6;  // [1] factor f for a skilled learner, to whom guidance does more harm
  // [1] run_error() that counts as the worst possible trial: the largest error that still reaches a pass grade of 6
  double full_error = 0.4;
  double per_error = 0.4;       // [1] factor k: gain added after the worst possible trial
  double min_gain = 0.05;       // [1] smaller gains are treated as 0
  double skill_memory = 0.7;    // [1] weight of the previous skill estimate in the running mean
  double bandwidth_from = 0.4;  // [1] skill from which only errors get feedback, without hints
  double summary_from = 0.75;   // [1] skill from which feedback comes only at the end
};

// A trial after a pause of at least this length is a retention test. Engineering value: 20 h normally include a night.
inline constexpr std::int64_t kRetentionPause = std::int64_t{20} * 3600;  // [s]

struct TrialPlan {
  double guidance = 0.0;    // [1] gain of the lever's guidance, 0 to 1
  double pedal_help = 0.0;  // [1] gain of the help for the feet; if both are 0, the trial is graded
  HintStyle hints = HintStyle::prescriptive;
};

// After each trial, helped or not, each limb's gain g becomes f g + k e, limited to 0 to 1. The error e is the trial's
// lever_error() or pedal_error() divided by `full_error`, at most 1, because help for one limb cannot mend what the other
// did wrong. The factor k is `per_error`. The factor f falls from `forgetting` to `forgetting_skilled` as skill, a running
// mean of the whole run's error, grows. Two of every four trials are without help, in an order drawn from the seed. The
// same seed and errors always give the same plans.
class GuidancePolicy {
 public:
  explicit GuidancePolicy(std::uint64_t seed, const GuidanceConfig& config = {});

  TrialPlan next();
  TrialPlan retention() const noexcept;  // plan of a retention test: unguided, feedback only at the end
  // Errors of the trial just driven: run_error(), lever_error(), pedal_error()
  void learn(double error, double of_lever, double of_pedals) noexcept;

  double gain() const noexcept { return lever_; }         // [1] of the lever's guidance
  double pedal_gain() const noexcept { return pedals_; }  // [1]
  double skill() const noexcept { return skill_; }        // [1] running mean of one minus the trial error

 private:
  void shuffle() noexcept;

  GuidanceConfig config_;
  std::uint64_t random_;
  double lever_, pedals_;
  double skill_ = 0.0;
  std::array<bool, 4> guided_{true, true, false, false};
  std::size_t trial_ = 0;
};

}  // namespace gearshift::lessons
