#include "app/demo/render_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "app/base/same_file.h"
#include "app/cabin/stage/stage.h"
#include "app/demo/still_scene.h"
#include "engine/model/gltf.h"

namespace gearshift::demo {
namespace {

// Parses "X,Y,Z:X,Y,Z", the positions of eye and target.
std::optional<std::array<glm::dvec3, 2>> two_points(std::string_view text) {
  std::array<double, 6> number{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (i > 0 && (at == end || *at++ != (i == 3 ? ':' : ','))) return {};
    const auto [next, error] = std::from_chars(at, end, number[i]);
    if (error != std::errc{} || !std::isfinite(number[i]) || std::abs(number[i]) > 1e4) return {};
    at = next;
  }
  if (at != end) return {};
  return std::array<glm::dvec3, 2>{{{number[0], number[1], number[2]}, {number[3], number[4], number[5]}}};
}

constexpr double kField = 58.0;  // [deg] default field of view of a camera without a name

bool is_named(const std::string& camera) {
  return camera != kFittingCamera && camera.find(':') == std::string::npos;
}

engine::EyePose chosen_eye(const std::string& text) {
  if (is_named(text)) return cabin::camera(text);
  const auto points = two_points(text);
  if (!points || glm::distance((*points)[0], (*points)[1]) < 1e-6)
    throw std::invalid_argument(fmt::format(
        "--camera {}: must be two different points (eye and target) in metres, written as X,Y,Z:X,Y,Z", text));
  return engine::look_at((*points)[0], (*points)[1]);
}

// Throws if the picture would overwrite a file that belongs to the model. Called after loading, because only then are
// the names of the model's buffer and texture files known.
void check_not_written_over(const engine::Model& model, const std::filesystem::path& picture) {
  for (const std::filesystem::path& file : model.files) {
    if (base::is_same_file(picture, file))
      throw std::runtime_error(fmt::format(
          "--out: the picture would overwrite {}, a file of the model; choose another file", file.string()));
  }
}

}  // namespace

void check_camera(const std::string& text) {
  if (text != kFittingCamera) (void)chosen_eye(text);
}

RenderFileResult render_file(const RenderFileSetup& setup) {
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  const engine::Model model = engine::read_gltf(setup.file);
  check_not_written_over(model, setup.out);
  RenderFileResult result;
  result.triangles = model.triangle_count();
  result.skipped = model.skipped;
  result.load_ms = ms_since(start);

  engine::FrameScene scene = still_scene(model);
  const int mirror = model.node("InteriorMirrorSurface");
  if (mirror != engine::kNone && model.nodes[static_cast<std::size_t>(mirror)].mesh != engine::kNone)
    scene.mirror = mirror;
  const double field = setup.field.value_or(is_named(setup.camera) ? cabin::camera_field(setup.camera) : kField);
  cabin::ViewConfig config = setup.view;
  engine::EyePose eye;
  if (setup.camera == kFittingCamera) {
    const FittingView fitting = fitting_view(model, field * std::numbers::pi / 180.0);
    eye = fitting.eye;
    config.near_plane = std::min(config.near_plane, fitting.nearest / 2.0);
  } else {
    eye = chosen_eye(setup.camera);
  }
  cabin::CabinView view(config, nullptr, nullptr);
  view.set_model(model);
  view.draw(scene, eye, field);
  const engine::Image picture = view.picture();
  result.first_frame_ms = ms_since(start);
  result.draws = view.renderer().draws();
  result.device = view.gpu().name;
  engine::write_png(setup.out, picture);
  return result;
}

}  // namespace gearshift::demo
