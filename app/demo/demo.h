// Renders the tour and two lessons offscreen, deterministically: pictures, sound, traces, plots, a learner's report and
// a page that shows them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/cabin/view/cabin_view.h"
#include "app/lab/tour/tour.h"

namespace gearshift::demo {

struct DemoSetup {
  lab::TourSetup tour;
  cabin::ViewConfig view;
  double film_rate = 0.0;  // [1/s] pictures of the whole drive from the driver's eye; 0: only the key pictures
};

struct DemoPicture {
  std::string file, caption;
};

// One drive and its pictures.
struct DemoChapter {
  std::string title;
  std::vector<std::string> text;  // sentences
  std::string trace;              // file, or empty
  std::vector<DemoPicture> pictures;
};

struct DemoResult {
  lab::TourResult tour;
  std::vector<DemoChapter> chapters;  // the drive through every gear, then the lessons
  bool has_report = false;            // report.html: there was a lesson
  bool passed = true;                 // every lesson was passed
  int film_frames = 0;
  double picture_ms = 0.0;  // [ms] median time to draw a picture and read it back
  std::string device;       // GPU that drew the pictures
  std::uint64_t validation_messages = 0;

  std::size_t pictures() const;
};

// Writes to setup.tour.folder, which must exist: NAME.png for each moment, contact_sheet.png, film/00000.png ...,
// demo.wav, tour.trace, tour.csv, trajectory and force (svg, png), LESSON.trace, report.html, index.html. If no shipped
// car has all gears of the gate, the car stands still and there are no lessons. Throws FileError, GltfError, GpuError.
DemoResult run_demo(const DemoSetup& setup, const lab::TourProgress& progress);

}  // namespace gearshift::demo
