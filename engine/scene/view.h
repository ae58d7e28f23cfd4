// The viewpoint of a frame. Depth is reversed: 1 at the near plane, 0 at infinity. As in Vulkan's clip space, y points
// down.
#pragma once

#include <array>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gearshift::engine {

// Half angles [rad] of an off-axis frustum, as in OpenXR; left and down are negative.
struct Fov {
  double left = 0.0, right = 0.0, down = 0.0, up = 0.0;
};

struct EyePose {
  glm::dvec3 position{0.0};                    // [m]
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // the eye looks along -Z; +Y is up
};

// A pose can also describe a coordinate space within a surrounding space. If pose b is given in the space of pose a,
// then a * b is pose b in the surrounding space.
EyePose operator*(const EyePose& a, const EyePose& b);
EyePose inverse(const EyePose& pose);
glm::dvec3 operator*(const EyePose& pose, glm::dvec3 point);

struct View {
  glm::mat4 view_from_world{1.0f};
  glm::mat4 clip_from_view{1.0f};
  glm::vec3 eye{0.0f};  // [m] world
};

// Projection with an infinite far plane. `near_plane` [m]: > 0.
glm::mat4 off_axis_projection(const Fov& fov, double near_plane);

// Symmetric frustum. `vertical` [rad]: vertical field of view. `aspect`: width / height.
Fov symmetric_fov(double vertical, double aspect);

View view_from(const EyePose& eye, const Fov& fov, double near_plane);
EyePose look_at(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up = {0.0, 1.0, 0.0});

// Two eyes that are `ipd` [m] apart. Their axes are parallel, and their off-axis frusta coincide on a screen `distance`
// [m] ahead. A point at distance z ahead has a disparity of f ipd (1/z - 1/distance), where f is the focal length in
// pixels.
struct StereoEyes {
  std::array<EyePose, 2> pose;  // left, right
  std::array<Fov, 2> fov;
};
StereoEyes stereo_eyes(const EyePose& head, const Fov& centre, double ipd, double distance);

// Projects a world point. Returns x and y [px] from the upper left corner, and as z the distance [m] beyond the near
// plane. z is negative for a point before the near plane or behind the eye.
glm::dvec3 project(const View& view, glm::dvec3 point, glm::dvec2 size_px);

}  // namespace gearshift::engine
