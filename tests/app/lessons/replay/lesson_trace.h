// A lesson driven by a simulated driver. The drive was recorded and also observed live, so that tests can compare the
// replay with the live samples.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "app/lessons/simulated_driver/lesson_drive.h"
#include "tests/app/lessons/simulated_driver/lessons.h"
#include "tests/support/temp_folder.h"

namespace gearshift::test {

struct LessonTrace {
  explicit LessonTrace(std::string_view lesson, double skill_error = 0.7, double guidance = 0.0)
      : file(folder / "lesson.trace") {
    lessons::LessonDriveConfig config = shipped_drive(lesson, 3);
    config.skill = lessons::skill_of(skill_error);
    config.guidance = guidance;
    config.trace = file;
    config.on_cycle = [this](const vehicle::DriveSample& sample) { live.push_back(sample); };
    result = lessons::drive_lesson(config);
  }

  TempFolder folder;
  std::filesystem::path file;
  std::vector<vehicle::DriveSample> live;  // every cycle of the live drive
  lessons::LessonResult result;
};

// One trace, shared by all tests that only read it.
inline const LessonTrace& upshifts() {
  static const LessonTrace trace("up_through_the_gears");
  return trace;
}

}  // namespace gearshift::test
