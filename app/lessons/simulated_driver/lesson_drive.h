// Drives a lesson with a simulated driver. Hand, lever, loop, car and assessment run on a virtual clock, as fast as
// possible.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "app/lessons/assessment/hint_style.h"
#include "app/lessons/assessment/lesson.h"
#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/simulated_driver/driver_skill.h"
#include "app/lessons/simulated_driver/simulated_drive.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_event.h"

namespace gearshift::lessons {

struct LessonDriveConfig {
  Lesson lesson;
  vehicle::CarSpec car;
  haptics::GateLayout gate;
  DriverSkill skill;
  DeliberateErrors errors;
  LessonMode mode = LessonMode::by_yourself;
  HintStyle hints = HintStyle::prescriptive;
  double guidance = 0.0;                                      // [1] gain of the guidance force, 0 to 1
  std::uint64_t seed = 1;                                     // seed of the driver and of the tooth positions
  double rate = 1000.0;                                       // [Hz] cycles per second, 100 to 4000
  std::filesystem::path trace;                                // empty: none
  std::function<void(const vehicle::DriveSample&)> on_cycle;  // called every cycle; may be empty
  // Called for each event of a cycle, before `judge` and on_cycle; may be empty.
  std::function<void(const haptics::HapticEvent&)> on_event;
};

// State of the lesson after a cycle, for the driver's next action.
struct LessonProgress {
  std::size_t step = 0;
  int guided_gear = haptics::kNeutralGear;
  bool is_over = false;
};
using LessonJudge = std::function<LessonProgress(const vehicle::DriveSample&)>;

// Drives until `judge` reports the end or the driver gives up. Throws like the overload without `judge` (below).
void drive_lesson(const LessonDriveConfig& config, const LessonJudge& judge);

// Drives with a LessonRun as judge. The result is exactly reproducible. Throws std::invalid_argument if lesson, car and
// gate do not fit together. Throws FileError if the trace cannot be created (before the first cycle) or completed
// (after the last cycle).
LessonResult drive_lesson(const LessonDriveConfig& config);

}  // namespace gearshift::lessons
