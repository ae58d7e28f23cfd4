#include <stdexcept>
#include <string>

#include "app/stage/stage.h"

namespace gearshift {
namespace {

struct NamedCamera {
  const char* name;
  glm::dvec3 eye, target;  // [m]
};

constexpr glm::dvec3 kDriverEye{0.0, 0.635, 0.05};
constexpr NamedCamera kCameras[] = {
    {"driver", kDriverEye, {0.23, 0.205, -0.80}},
    {"lever", {0.07, 0.36, -0.20}, {0.325, 0.10, -0.31}},
    {"gate", {0.235, 0.275, -0.175}, {0.325, 0.070, -0.272}},
    {"cluster", {0.0, 0.455, -0.475}, {0.0, 0.374, -0.70}},
    {"gearbox", {0.56, 0.45, -0.12}, {0.70, 0.20, -0.40}},
};

}  // namespace

EyePose camera(std::string_view name) {
  std::string names;
  for (const NamedCamera& camera : kCameras) {
    if (name == camera.name) return look_at(camera.eye, camera.target);
    names += names.empty() ? camera.name : std::string(", ") + camera.name;
  }
  throw std::invalid_argument("no camera '" + std::string(name) + "': there are " + names);
}

}  // namespace gearshift
