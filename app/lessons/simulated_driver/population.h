// Populations of simulated drivers of one skill, whose styles differ; and the norm of practised ones.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/lessons/assessment/norm.h"
#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::lessons {

enum class Limbs { all, hand, feet };  // the limbs to which the skill error applies; the others are practised

struct Population {
  double error = 0.0;  // [1] see skill_of()
  int drivers = 0;
  std::uint64_t seed = 1;  // other seeds give other drivers
  LessonMode mode = LessonMode::by_yourself;
  StyleSpread style{};
  Limbs limbs = Limbs::all;
};

// Each driver drives the lesson once, without guidance. With LessonMode::follow_me, some wait until they have read each
// prompt and others look ahead. Skill, mode, guidance and seed of `drive` are ignored. Uses all processor cores; the
// results depend only on the arguments.
std::vector<LessonResult> drive_population(const LessonDriveConfig& drive, const Population& population);

// Norm of the lesson in this mode. One population of practised drivers gives the figures, a second one the limit: the
// distance that 96 % of it stay below, at least 1, times 1.3. The figures are rounded as in the file.
Norm derive_norm(const LessonDriveConfig& drive, LessonMode mode);

// Seeds of the two populations; a population that checks norms needs another one.
inline constexpr std::uint64_t kNormSeed = 101, kLimitSeed = 202;
inline constexpr int kNormDrivers = 50;  // in each of the two

}  // namespace gearshift::lessons
