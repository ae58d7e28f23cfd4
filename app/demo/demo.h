// The tour and two lessons in the cabin, offscreen and deterministic: pictures, sound, traces, plots, a learner's report,
// and a page that shows them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/tour/tour.h"
#include "app/view/cabin_view.h"

namespace gearshift {

struct DemoSetup {
  TourSetup tour;
  ViewConfig view;
  double film_rate = 0.0;  // [1/s] pictures of the drive from the driver's eye; 0: none, the key pictures alone
};

struct DemoPicture {
  std::string file, caption;
};

// A drive with its pictures.
struct DemoChapter {
  std::string title;
  std::vector<std::string> text;  // sentences
  std::string trace;              // file, or empty
  std::vector<DemoPicture> pictures;
};

struct DemoResult {
  TourResult tour;
  std::vector<DemoChapter> chapters;  // the drive through every gear, then the lessons
  bool has_report = false;            // report.html: there was a lesson
  bool passed = true;                 // each lesson that is shown
  int film_frames = 0;
  double picture_ms = 0.0;  // [ms] median of a picture, drawn and read back
  std::string device;       // that drew them
  std::uint64_t validation_messages = 0;

  std::size_t pictures() const;
};

// Into setup.tour.folder, which exists: NAME.png for each moment, contact_sheet.png, film/00000.png ..., demo.wav,
// tour.trace, tour.csv, trajectory and force (svg, png), LESSON.trace, report.html, index.html. A gate with a gear that
// no shipped car has is shown with a car that stands, and without lessons. Throws FileError, GltfError, GpuError.
DemoResult run_demo(const DemoSetup& setup, const TourProgress& progress);

}  // namespace gearshift
