// Renders any glTF file to a picture.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "app/cabin/view/cabin_view.h"

namespace gearshift::demo {

inline double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

inline constexpr const char* kFittingCamera = "fit";  // a camera that shows the whole model

struct RenderFileSetup {
  std::filesystem::path file;
  std::filesystem::path out;  // PNG
  cabin::ViewConfig view;
  std::optional<double> field;          // [deg] across the image's shorter side; empty: the camera's default
  std::string camera = kFittingCamera;  // kFittingCamera, name of a cabin camera, or "X,Y,Z:X,Y,Z": eye and target [m]
};

struct RenderFileResult {
  std::uint64_t triangles = 0;
  int draws = 0;
  double load_ms = 0.0, first_frame_ms = 0.0;  // [ms] durations
  std::vector<std::string> skipped;            // see Model::skipped
  std::string device;
};

void check_camera(const std::string& text);  // throws std::invalid_argument with a one-sentence message

// Throws GltfError, GpuError, std::invalid_argument (camera), std::runtime_error (out).
RenderFileResult render_file(const RenderFileSetup& setup);

}  // namespace gearshift::demo
