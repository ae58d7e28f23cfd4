// A pose of the yoke, given by the tangents of its two angles, and the conversions between gate plane and arcs at this
// pose.
//
// Each cycle converts several times, so the tangents are computed once per pose and the other functions are inline. The
// conversions are those of kinematics.h, with arc lengths (rho theta, -rho phi) instead of angles, so that the radius
// rho cancels in the conversions of velocities and forces.
//
// With a = tan(theta), b = tan(phi), n = sqrt(1 + a^2 + b^2), A = 1 + a^2 and B = 1 + b^2 the tip is
// rho (a, -b, 1) / n. Since rho da = A d(arc x) and rho db = -B d(arc y),
//
//     J = d plane / d arc = 1/n^3 [ A B   a b B ]        J^-1 = n [ 1        -a b / A ]
//                                 [ a b A  A B  ]                 [ -a b / B  1       ]
#pragma once

#include <cmath>

#include <glm/vec2.hpp>

namespace gearshift::haptics {

struct PlanePose {
  double a = 0.0;  // tan(theta)
  double b = 0.0;  // tan(phi)
  double n = 1.0;
};

inline PlanePose plane_pose(double tan_theta, double tan_phi) noexcept {
  return {tan_theta, tan_phi, std::sqrt(1.0 + tan_theta * tan_theta + tan_phi * tan_phi)};
}

// Position of the tip [m] in the gate plane, for a yoke of this radius.
inline glm::dvec2 plane_position(const PlanePose& pose, double radius) noexcept {
  const double scale = radius / pose.n;
  return {scale * pose.a, -scale * pose.b};
}

// Converts velocities along the arcs to velocities in the gate plane (plane = J arc) and back. [m/s]
inline glm::dvec2 plane_velocity(const PlanePose& pose, glm::dvec2 arc) noexcept {
  const double scale = 1.0 / (pose.n * pose.n * pose.n);
  const double ab = pose.a * pose.b, a1 = 1.0 + pose.a * pose.a, b1 = 1.0 + pose.b * pose.b;
  return {scale * b1 * (a1 * arc.x + ab * arc.y), scale * a1 * (ab * arc.x + b1 * arc.y)};
}

inline glm::dvec2 arc_velocity(const PlanePose& pose, glm::dvec2 plane) noexcept {
  const double ab = pose.a * pose.b, a1 = 1.0 + pose.a * pose.a, b1 = 1.0 + pose.b * pose.b;
  return {pose.n * (plane.x - ab / a1 * plane.y), pose.n * (plane.y - ab / b1 * plane.x)};
}

// Converts forces in the gate plane to forces along the arcs (arc = J^T plane, by virtual work) and back. [N]
inline glm::dvec2 arc_force(const PlanePose& pose, glm::dvec2 plane) noexcept {
  const double scale = 1.0 / (pose.n * pose.n * pose.n);
  const double ab = pose.a * pose.b, a1 = 1.0 + pose.a * pose.a, b1 = 1.0 + pose.b * pose.b;
  return {scale * a1 * (b1 * plane.x + ab * plane.y), scale * b1 * (ab * plane.x + a1 * plane.y)};
}

inline glm::dvec2 plane_force(const PlanePose& pose, glm::dvec2 arc) noexcept {
  const double ab = pose.a * pose.b, a1 = 1.0 + pose.a * pose.a, b1 = 1.0 + pose.b * pose.b;
  return {pose.n * (arc.x - ab / b1 * arc.y), pose.n * (arc.y - ab / a1 * arc.x)};
}

}  // namespace gearshift::haptics
