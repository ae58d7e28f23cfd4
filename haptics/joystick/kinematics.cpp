#include "haptics/joystick/kinematics.h"

#include <cmath>

#include "haptics/joystick/plane_pose.h"

namespace gearshift::haptics {
namespace {

struct SinCos {
  double st, ct, sp, cp;  // sines and cosines of theta and phi
  double d;               // D = 1 - sin^2(phi) sin^2(theta), under the root in eqs (1), (2) and (5)
};

SinCos sin_cos(JointAngles q) noexcept {
  SinCos s{std::sin(q.theta), std::cos(q.theta), std::sin(q.phi), std::cos(q.phi), 0.0};
  s.d = 1.0 - s.sp * s.sp * s.st * s.st;
  return s;
}

PlanePose pose_at(JointAngles q) noexcept {
  return plane_pose(std::tan(q.theta), std::tan(q.phi));
}

}  // namespace

// Eq (2) of the paper, corrected. The paper prints -sin(phi) sin(theta) in the y component. But the normal of eq (1)
// has cos(theta) there, and only cos(theta) puts the tip on the sphere, |p| = rho.
glm::dvec3 tip_position(const YokeGeometry& yoke, JointAngles q) noexcept {
  const SinCos s = sin_cos(q);
  return yoke.radius / std::sqrt(s.d) * glm::dvec3(s.cp * s.st, -s.sp * s.ct, s.cp * s.ct);
}

// Eq (3).
glm::dvec3 tip_position_small_angle(const YokeGeometry& yoke, JointAngles q) noexcept {
  return yoke.radius * glm::dvec3(q.theta, -q.phi, 1.0);
}

JointAngles joint_angles(glm::dvec3 tip) noexcept {
  return {std::atan2(tip.x, tip.z), std::atan2(-tip.y, tip.z)};
}

glm::dvec2 plane_position(const YokeGeometry& yoke, JointAngles q) noexcept {
  return plane_position(pose_at(q), yoke.radius);
}

JointAngles joint_angles_from_plane(const YokeGeometry& yoke, glm::dvec2 plane) noexcept {
  const double z_squared = yoke.radius * yoke.radius - plane.x * plane.x - plane.y * plane.y;
  return joint_angles({plane, std::sqrt(z_squared)});
}

glm::dvec2 workspace_half_extent(const YokeGeometry& yoke) noexcept {
  return yoke.radius * glm::dvec2(std::sin(yoke.theta_limit), std::sin(yoke.phi_limit));
}

glm::dvec2 arc_position(const YokeGeometry& yoke, JointAngles q) noexcept {
  return {yoke.radius * q.theta, -yoke.radius * q.phi};
}

// Eq (5) of the paper, corrected: in the x component the paper prints sin(phi) instead of cos(phi); in the y component
// it omits the sign. The z component makes the force tangential to the sphere.
glm::dvec3 tip_force(const YokeGeometry& yoke, JointAngles q, JointTorques torque) noexcept {
  const SinCos s = sin_cos(q);
  const glm::dvec3 direction{torque.theta * s.ct / s.cp, -torque.phi * s.cp / s.ct,
                             -(torque.theta * s.st / s.cp + torque.phi * s.sp / s.ct)};
  return std::sqrt(s.d) / yoke.radius * direction;
}

// Eq (6) of the paper: converts the torques to forces along the arcs (rho theta, -rho phi).
glm::dvec2 tip_force_small_angle(const YokeGeometry& yoke, JointTorques torque) noexcept {
  return {torque.theta / yoke.radius, -torque.phi / yoke.radius};
}

glm::dvec2 plane_force(const YokeGeometry& yoke, JointAngles q, JointTorques torque) noexcept {
  return plane_force(pose_at(q), tip_force_small_angle(yoke, torque));
}

JointTorques joint_torques_from_plane(const YokeGeometry& yoke, JointAngles q, glm::dvec2 force) noexcept {
  const glm::dvec2 arc = arc_force(pose_at(q), force);
  return {yoke.radius * arc.x, -yoke.radius * arc.y};
}

}  // namespace gearshift::haptics
