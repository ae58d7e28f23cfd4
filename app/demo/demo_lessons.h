// The lessons of the demo: driven by a simulated learner who gets better from trial to trial, the last one filmed.
#pragma once

#include <string>
#include <vector>

#include "app/demo/demo.h"
#include "app/demo/filmed_drive.h"

namespace gearshift {

struct DemoLesson {
  std::vector<LessonResult> trials;  // oldest first, the filmed one too
  FilmedDrive last;
  std::string trace;  // its file, in the demo's folder
};

// Those that the gate has the gears for. Throws FileError.
std::vector<DemoLesson> drive_demo_lessons(const DemoSetup& setup, const CarSpec& car, const TourProgress& progress);

// What came of it, in sentences.
std::vector<std::string> result_words(const FilmedDrive& drive);

// report.html, of that learner and of nobody else: the user's own history is not touched. Throws FileError.
void write_demo_report(const DemoSetup& setup, const std::vector<DemoLesson>& lessons);

}  // namespace gearshift
