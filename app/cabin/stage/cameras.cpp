#include <stdexcept>
#include <string>

#include "app/cabin/stage/stage.h"

namespace gearshift::cabin {
namespace {

struct NamedCamera {
  const char* name;
  glm::dvec3 eye, target;  // [m]
  double field;            // [deg] field of view, see camera_field()
};

constexpr glm::dvec3 kDriverEye{0.0, 0.635, 0.05};
constexpr NamedCamera kCameras[] = {
    {"driver", kDriverEye, {0.2805, 0.1275, -0.7647}, 72.0},  // shows everything from the horizon down to the gate
    {"ahead", kDriverEye, {0.2249, 0.5999, -0.9240}, 62.0},   // shows road, instruments and interior mirror
    {"lever", {0.07, 0.36, -0.20}, {0.325, 0.10, -0.31}, 58.0},
    {"gate", {0.235, 0.275, -0.175}, {0.325, 0.070, -0.272}, 58.0},
    {"cluster", {0.0, 0.455, -0.475}, {0.0, 0.374, -0.70}, 58.0},
    {"gearbox", {0.56, 0.45, -0.12}, {0.70, 0.20, -0.40}, 58.0},
};

const NamedCamera& named(std::string_view name) {
  std::string names;
  for (const NamedCamera& camera : kCameras) {
    if (name == camera.name) return camera;
    names += names.empty() ? camera.name : std::string(", ") + camera.name;
  }
  throw std::invalid_argument("no camera is named '" + std::string(name) + "'; choose one of " + names);
}

}  // namespace

engine::EyePose camera(std::string_view name, DriveSide side) {
  const NamedCamera& camera = named(name);
  return engine::look_at(on_side(side, camera.eye), on_side(side, camera.target));
}

double camera_field(std::string_view name) {
  return named(name).field;
}

}  // namespace gearshift::cabin
