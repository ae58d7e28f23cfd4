// Any glTF file as a picture.
#pragma once

#include <filesystem>
#include <string>

#include "app/view/cabin_view.h"

namespace gearshift {

struct RenderFileSetup {
  std::filesystem::path file;
  std::filesystem::path out;  // PNG
  ViewConfig view;
  std::string camera = "fit";  // "fit", a camera of the cabin, or "X,Y,Z:X,Y,Z" eye and target [m]
};

struct RenderFileResult {
  std::uint64_t triangles = 0;
  int draws = 0;
  double load_ms = 0.0, first_frame_ms = 0.0;  // [ms]
  std::vector<std::string> skipped;            // see Model::skipped
  std::string device;
};

// Throws GltfError, GpuError, std::invalid_argument (camera), std::runtime_error (out).
RenderFileResult render_file(const RenderFileSetup& setup);

}  // namespace gearshift
