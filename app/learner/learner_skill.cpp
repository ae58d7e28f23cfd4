#include "app/learner/learner_skill.h"

#include <algorithm>

namespace gearshift {
namespace {

// [engineering value]s: about what separates the first hour from routine.
//
// Of the brake: in the same emergency novices decelerated half as much as experienced drivers (Loeb, Kandadai, McDonald,
// Winston. Emergency Braking in Adults Versus Novice Teen Drivers. 2015). Of a launch: pupils rush the pedal through the
// bite point and are shy of the throttle, which is what instructors give as the causes of a stall; how much of it nobody
// has measured.
constexpr LearnerSkill kBeginner{0.45, 0.18, 0.007, 0.05, 0.30, 0.50, 0.18, 2.0, 0.25, 0.50, 0.5, 0.75, 0.0, 0.45};

}  // namespace

LearnerSkill skill_of(double error) noexcept {
  const double e = std::clamp(error, 0.0, 1.0);
  const LearnerSkill best;
  const auto between = [&](double LearnerSkill::*value) { return best.*value + e * (kBeginner.*value - best.*value); };
  return {between(&LearnerSkill::reaction),     between(&LearnerSkill::timing_spread),
          between(&LearnerSkill::aim_noise),    between(&LearnerSkill::pedal_noise),
          between(&LearnerSkill::rev_spread),   between(&LearnerSkill::release_spread),
          between(&LearnerSkill::pace),         between(&LearnerSkill::haste),
          between(&LearnerSkill::hearing),      between(&LearnerSkill::foot_change),
          between(&LearnerSkill::brake_effort), between(&LearnerSkill::gas),
          between(&LearnerSkill::reading),      between(&LearnerSkill::bite_fall)};
}

LearnerFaults only(FaultKind kind, double amount) noexcept {
  LearnerFaults faults;
  faults.amount[static_cast<std::size_t>(kind)] = amount;
  return faults;
}

}  // namespace gearshift
