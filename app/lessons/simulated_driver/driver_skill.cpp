#include "app/lessons/simulated_driver/driver_skill.h"

#include <algorithm>
#include <cmath>

#include "haptics/device/gaussian_noise.h"

namespace gearshift::lessons {
namespace {

// A beginner in the first hour of practice. Engineering values.
//
// `brake_effort`: in the same emergency, novices decelerated half as much as experienced drivers (Loeb, Kandadai,
// McDonald, Winston. Emergency Braking in Adults Versus Novice Teen Drivers. 2015).
//
// `release_haste` and `launch_speed_factor`: beginners lift the clutch pedal too fast through the bite point and use
// too little throttle; instructors name both as causes of stalls. No measurements were found.
constexpr DriverSkill kBeginner{0.45, 0.18, 0.007, 0.05, 0.30, 0.50, 0.18, 2.0, 0.25, 0.50, 0.5, 0.75, 0.0, 0.45};

}  // namespace

DriverSkill skill_of(double error) noexcept {
  const double e = std::clamp(error, 0.0, 1.0);
  const DriverSkill best;
  const auto between = [&](double DriverSkill::*value) { return best.*value + e * (kBeginner.*value - best.*value); };
  return {between(&DriverSkill::reaction),      between(&DriverSkill::timing_spread),
          between(&DriverSkill::aim_noise),     between(&DriverSkill::pedal_noise),
          between(&DriverSkill::rev_spread),    between(&DriverSkill::release_spread),
          between(&DriverSkill::pace),          between(&DriverSkill::release_haste),
          between(&DriverSkill::hearing_delay), between(&DriverSkill::foot_change),
          between(&DriverSkill::brake_effort),  between(&DriverSkill::launch_speed_factor),
          between(&DriverSkill::reading_time),  between(&DriverSkill::max_bite_drop)};
}

DriverSkill in_style(const DriverSkill& skill, std::uint64_t seed, const StyleSpread& spread) {
  haptics::GaussianNoise random(seed);
  const auto factor = [&](double deviation) { return std::exp(deviation * random.next()); };
  DriverSkill styled = skill;
  styled.pace *= factor(spread.pace);
  const double reaction = factor(spread.reaction);
  styled.reaction *= reaction;
  styled.foot_change *= reaction;
  styled.release_haste *= factor(spread.haste);
  const double gas = factor(spread.gas);
  styled.launch_speed_factor *= gas;
  styled.throttle_factor *= gas;
  styled.hearing_delay *= factor(spread.hearing);
  styled.bite_error += spread.bite_error * random.next();
  return styled;
}

DeliberateErrors deliberate_error(ErrorKind kind, double amount) noexcept {
  DeliberateErrors errors;
  errors.amount[static_cast<std::size_t>(kind)] = amount;
  return errors;
}

}  // namespace gearshift::lessons
