// Any glTF file as a picture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/view/cabin_view.h"

namespace gearshift {

inline constexpr const char* kFittingCamera = "fit";  // all of the model is seen

struct RenderFileSetup {
  std::filesystem::path file;
  std::filesystem::path out;  // PNG
  ViewConfig view;
  std::optional<double> field;          // [deg] across the shorter side; empty: the camera's own
  std::string camera = kFittingCamera;  // or a camera of the cabin, or "X,Y,Z:X,Y,Z" eye and target [m]
};

struct RenderFileResult {
  std::uint64_t triangles = 0;
  int draws = 0;
  double load_ms = 0.0, first_frame_ms = 0.0;  // [ms]
  std::vector<std::string> skipped;            // see Model::skipped
  std::string device;
};

void check_camera(const std::string& text);  // throws std::invalid_argument with one sentence

// Throws GltfError, GpuError, std::invalid_argument (camera), std::runtime_error (out).
RenderFileResult render_file(const RenderFileSetup& setup);

}  // namespace gearshift
