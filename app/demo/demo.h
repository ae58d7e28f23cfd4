// Renders the tour (a drive through every gear) and two lessons off screen, with the same result on every run:
// pictures, sound, traces, plots, a learner's report and a page that shows them.
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
  double film_rate = 0.0;  // [1/s] frame rate of a film of the whole drive from the driver's eye; 0: no film
};

struct DemoPicture {
  std::string file, caption;
};

// One drive with its pictures.
struct DemoChapter {
  std::string title;
  std::vector<std::string> text;  // description, in sentences
  std::string trace;              // file name of the recording; empty: no recording
  std::vector<DemoPicture> pictures;
};

struct DemoResult {
  lab::TourResult tour;
  std::vector<DemoChapter> chapters;  // the drive through every gear, then the lessons
  bool has_report = false;            // true if report.html was written, i.e. if there were lessons
  bool passed = true;                 // true if every lesson was passed
  int film_frames = 0;
  double picture_ms = 0.0;  // [ms] median time to draw a picture and read it back
  std::string device;       // name of the GPU that drew the pictures
  std::uint64_t validation_messages = 0;

  std::size_t pictures() const;
};

// Writes these files to setup.tour.folder, which must exist: NAME.png for each shot, contact_sheet.png, film/00000.png
// ..., demo.wav, tour.trace, tour.csv, trajectory and force (each as svg and png), LESSON.trace, report.html,
// index.html. If no shipped car has all gears of the gate, the tour has no car and the lessons are left out. Throws
// FileError, GltfError, GpuError.
DemoResult run_demo(const DemoSetup& setup, const lab::TourProgress& progress);

}  // namespace gearshift::demo
