// The tour in the cabin, offscreen and deterministic: pictures, sound, trace, plots, and a page that shows them.
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

struct DemoResult {
  TourResult tour;
  std::vector<DemoPicture> pictures;
  int film_frames = 0;
  double picture_ms = 0.0;  // [ms] median of a picture, drawn and read back
  std::string device;       // that drew them
  std::uint64_t validation_messages = 0;
};

// Into setup.tour.folder, which exists: NAME.png for each moment, contact_sheet.png, film/00000.png ..., demo.wav,
// tour.trace, tour.csv, trajectory and force (svg, png), index.html. Throws FileError, GltfError, GpuError.
DemoResult run_demo(const DemoSetup& setup, const TourProgress& progress);

}  // namespace gearshift
