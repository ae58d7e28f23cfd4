#include "engine/scene/view.h"

#include <cmath>

namespace gearshift::engine {

namespace {

constexpr glm::dvec3 kRight{1.0, 0.0, 0.0};

}  // namespace

EyePose operator*(const EyePose& a, const EyePose& b) {
  return {a * b.position, glm::normalize(a.orientation * b.orientation)};
}

EyePose inverse(const EyePose& pose) {
  const glm::dquat back = glm::conjugate(pose.orientation);
  return {back * -pose.position, back};
}

glm::dvec3 operator*(const EyePose& pose, glm::dvec3 point) {
  return pose.position + pose.orientation * point;
}

// The projection matrix. l, r, d and u are the tangents of the left, right, down and up half angles; n is the distance
// of the near plane. A point (x, y, z) in view space, with z < 0 ahead of the eye, becomes
//   w = -z,   x_clip = (2 x + (r + l) z) / (r - l),   y_clip = -(2 y + (u + d) z) / (u - d),   z_clip = n
// So depth is n / -z: 1 at the near plane, 0 at infinity. Far points have dense depth values near 0, where a float has
// its finest steps (Upchurch, Desbrun. Tightening the Precision of Perspective Rendering. 2012).
glm::mat4 off_axis_projection(const Fov& fov, double near_plane) {
  const double left = std::tan(fov.left), right = std::tan(fov.right);
  const double down = std::tan(fov.down), up = std::tan(fov.up);
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 / (right - left);
  clip[1][1] = -2.0 / (up - down);
  clip[2][0] = (right + left) / (right - left);
  clip[2][1] = -(up + down) / (up - down);
  clip[2][3] = -1.0;
  clip[3][2] = near_plane;
  return glm::mat4(clip);
}

Fov symmetric_fov(double vertical, double aspect) {
  const double up = 0.5 * vertical, right = std::atan(aspect * std::tan(up));
  return {-right, right, -up, up};
}

View view_from(const EyePose& eye, const Fov& fov, double near_plane) {
  View view;
  const glm::dmat4 rotation = glm::mat4_cast(glm::conjugate(eye.orientation));
  glm::dmat4 view_from_world = rotation;
  view_from_world[3] = rotation * glm::dvec4(-eye.position, 1.0);
  view.view_from_world = glm::mat4(view_from_world);
  view.clip_from_view = off_axis_projection(fov, near_plane);
  view.eye = glm::vec3(eye.position);
  return view;
}

EyePose look_at(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up) {
  const glm::dvec3 ahead = glm::normalize(target - eye);
  // If `up` is parallel to `ahead`, use -z as the up direction. If `ahead` is parallel to z, too, use kRight.
  if (glm::length(glm::cross(ahead, up)) < 1e-6 * glm::length(up)) up = {0.0, 0.0, -1.0};
  if (glm::length(glm::cross(ahead, up)) < 1e-6) up = kRight;
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, up));
  return {eye, glm::quat_cast(glm::dmat3(right, glm::cross(right, ahead), -ahead))};
}

StereoEyes stereo_eyes(const EyePose& head, const Fov& centre, double ipd, double distance) {
  StereoEyes eyes;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const double offset = eye == 0 ? -0.5 * ipd : 0.5 * ipd;
    eyes.pose[eye] = {head.position + head.orientation * (offset * kRight), head.orientation};
    // An eye that is moved sideways by `offset` sees the edges of the fixed screen at other angles. The tangents of
    // these angles change by offset / distance.
    eyes.fov[eye] = centre;
    eyes.fov[eye].left = std::atan(std::tan(centre.left) - offset / distance);
    eyes.fov[eye].right = std::atan(std::tan(centre.right) - offset / distance);
  }
  return eyes;
}

glm::dvec3 project(const View& view, glm::dvec3 point, glm::dvec2 size_px) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_view) * (glm::dmat4(view.view_from_world) * glm::dvec4(point, 1.0));
  // clip.z is the distance of the near plane, and clip.w is the distance of the point. So clip.w - clip.z is the
  // distance of the point beyond the near plane.
  return {0.5 * size_px.x * (1.0 + clip.x / clip.w), 0.5 * size_px.y * (1.0 + clip.y / clip.w), clip.w - clip.z};
}

}  // namespace gearshift::engine
