// The lessons of the demo, driven by a simulated driver whose skill improves from trial to trial; the last is filmed.
#pragma once

#include <string>
#include <vector>

#include "app/demo/demo.h"
#include "app/demo/filmed_drive.h"

namespace gearshift::demo {

struct DemoLesson {
  std::vector<lessons::LessonResult> trials;  // oldest first, the filmed one too
  FilmedDrive last;
  std::string trace;  // its file, in the demo's folder
};

// Drives the lessons for which the gate has the gears. Throws FileError.
std::vector<DemoLesson> drive_demo_lessons(const DemoSetup& setup, const vehicle::CarSpec& car,
                                           const lab::TourProgress& progress);

// The result of a drive, in sentences.
std::vector<std::string> describe_result(const FilmedDrive& drive);

// Writes report.html for the simulated learner only; does not touch the user's history. Throws FileError.
void write_demo_report(const DemoSetup& setup, const std::vector<DemoLesson>& lessons);

}  // namespace gearshift::demo
