// This work is based on:
// Robert Kooima. Generalized Perspective Projection. 2008
#include "engine/render/mirror_view.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace gearshift::engine {

namespace {

constexpr float kMinEyeDistance = 1e-3f;  // [m] an eye closer to the mirror gets no mirror view

glm::vec4 row(glm::vec3 axis, float at_zero, const MirrorWindow& window, float width) {
  return glm::vec4(axis, at_zero - glm::dot(axis, window.origin)) / width;
}

}  // namespace

glm::vec4 MirrorWindow::u_row() const {
  return row(-right, high.x, *this, high.x - low.x);
}

glm::vec4 MirrorWindow::v_row() const {
  return row(-up, high.y, *this, high.y - low.y);
}

MirrorWindow mirror_window(const glm::mat4& world, const Box& mesh) {
  MirrorWindow window;
  const glm::vec2 scale(glm::length(glm::vec3(world[0])), glm::length(glm::vec3(world[1])));
  window.origin = glm::vec3(world[3]);
  window.right = glm::vec3(world[0]) / scale.x;
  window.up = glm::vec3(world[1]) / scale.y;
  window.normal = glm::cross(window.right, window.up);
  window.low = scale * glm::vec2(mesh.low);
  window.high = scale * glm::vec2(mesh.high);
  return window;
}

std::optional<View> mirror_view(const MirrorWindow& window, glm::vec3 eye) {
  const glm::vec3 from_origin = eye - window.origin;
  const float distance = glm::dot(from_origin, window.normal);
  if (distance < kMinEyeDistance || window.high.x <= window.low.x || window.high.y <= window.low.y) return std::nullopt;
  const double x = glm::dot(from_origin, window.right), y = glm::dot(from_origin, window.up);
  EyePose pose;
  pose.position = glm::dvec3(eye) - 2.0 * static_cast<double>(distance) * glm::dvec3(window.normal);
  pose.orientation = glm::quat_cast(glm::dmat3(-window.right, window.up, -window.normal));
  const double d = distance;
  const Fov through_window{std::atan((x - window.high.x) / d), std::atan((x - window.low.x) / d),
                           std::atan((window.low.y - y) / d), std::atan((window.high.y - y) / d)};
  return view_from(pose, through_window, d);
}

}  // namespace gearshift::engine
