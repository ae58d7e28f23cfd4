// The lessons of the demo. A simulated driver drives each lesson several times, with better skill from trial to trial;
// the last trial is filmed.
#pragma once

#include <string>
#include <vector>

#include "app/demo/demo.h"
#include "app/demo/filmed_drive.h"

namespace gearshift::demo {

struct DemoLesson {
  std::vector<lessons::LessonResult> trials;  // results of all trials, oldest first, including the filmed one
  FilmedDrive last;
  std::string trace;  // file name of the last trial's trace in the demo's folder
};

// Drives those of the demo's lessons whose gears the gate has. Throws FileError.
std::vector<DemoLesson> drive_demo_lessons(const DemoSetup& setup, const vehicle::CarSpec& car,
                                           const lab::TourProgress& progress);

// Describes the result of a drive, in sentences.
std::vector<std::string> describe_result(const FilmedDrive& drive);

// Writes report.html for the simulated driver only; does not touch the user's history. Throws FileError.
void write_demo_report(const DemoSetup& setup, const std::vector<DemoLesson>& lessons);

}  // namespace gearshift::demo
