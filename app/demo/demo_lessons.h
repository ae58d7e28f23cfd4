// The lessons of the demo. A simulated driver drives each lesson several times and gets better from trial to trial; the
// last trial is filmed.
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

// Drives those demo lessons whose gears exist in the gate. Throws FileError.
std::vector<DemoLesson> drive_demo_lessons(const DemoSetup& setup, const vehicle::CarSpec& car,
                                           const lab::TourProgress& progress);

// Describes the result of a drive in sentences.
std::vector<std::string> describe_result(const FilmedDrive& drive);

// Writes report.html about the simulated driver only; does not read or change the user's history. Throws FileError.
void write_demo_report(const DemoSetup& setup, const std::vector<DemoLesson>& lessons);

}  // namespace gearshift::demo
