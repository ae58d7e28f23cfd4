// Drives a lesson with a simulated learner: hand, lever, loop, car and teacher on a virtual clock, as fast as it goes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "app/learner/learner_skill.h"
#include "app/training/drive_sample.h"
#include "app/training/hint_style.h"
#include "app/training/lesson.h"
#include "app/training/lesson_result.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift {

struct LessonDriveConfig {
  Lesson lesson;
  CarSpec car;
  GateLayout gate;
  LearnerSkill skill;
  LearnerFaults faults;
  LessonMode mode = LessonMode::by_yourself;
  HintStyle hints = HintStyle::prescriptive;
  double guidance = 0.0;                          // [1] 0 to 1
  std::uint64_t seed = 1;                         // of learner and tooth phases
  double rate = 1000.0;                           // [Hz] 100 to 4000
  std::filesystem::path trace;                    // empty: none
  std::function<void(const DriveSample&)> watch;  // every cycle; may be empty
  std::function<void(const HapticEvent&)> hear;   // what happened in a cycle, before it is watched; may be empty
};

// The gate as the drive's lever has it. Throws as compile_gate() does.
Gate driven_gate(const GateLayout& layout);

// Who judges a drive, told of every cycle: what the learner does next hangs on it.
struct LessonStand {
  std::size_t step = 0;
  int guided_gear = kNeutralGear;
  bool over = false;
};
using LessonJudge = std::function<LessonStand(const DriveSample&)>;

// Until the judge says that it is over, or the learner gives up; mode and hints are the judge's. Throws as below.
void drive_lesson(const LessonDriveConfig& config, const LessonJudge& judge);

// The same, judged by a LessonRun. Deterministic to the bit. Throws std::invalid_argument where lesson, car and gate do not go together, FileError where
// the trace cannot be written: before the first cycle, or, where the disk got full, after the last one.
LessonResult drive_lesson(const LessonDriveConfig& config);

}  // namespace gearshift
