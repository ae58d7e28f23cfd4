// A lesson, driven by a simulated learner, recorded, and watched while it was driven: what a replay must show again.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "app/learner/lesson_drive.h"
#include "tests/app/learner/lessons.h"
#include "tests/support/temp_folder.h"

namespace gearshift {

struct LessonTrace {
  explicit LessonTrace(std::string_view lesson, double skill_error = 0.7, double guidance = 0.0)
      : file(folder / "lesson.trace") {
    LessonDriveConfig config = shipped_drive(lesson, 3);
    config.skill = skill_of(skill_error);
    config.guidance = guidance;
    config.trace = file;
    config.watch = [this](const DriveSample& sample) { live.push_back(sample); };
    result = drive_lesson(config);
  }

  TempFolder folder;
  std::filesystem::path file;
  std::vector<DriveSample> live;  // every cycle
  LessonResult result;
};

// The same one for every test that only reads it.
inline const LessonTrace& upshifts() {
  static const LessonTrace trace("up_through_the_gears");
  return trace;
}

}  // namespace gearshift
