// Kinematics and statics of the single-yoke joystick.
//
// This work is based on:
// Wei-Ching Lin, Kuu-Young Young. Design of Force-Reflection Joystick System for VR-Based Simulation.
// Section 2. Errata: the y component of eq (2) is -sin(phi) cos(theta); eq (5) is misprinted, and the forms below
// follow from virtual work.
#pragma once

#include <numbers>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "haptics/files/parameter.h"

namespace gearshift::haptics {

struct YokeGeometry {
  double radius = 0.120;                                 // [m] rho: distance from the yoke's centre to the tip
  double theta_limit = 40.0 * std::numbers::pi / 180.0;  // [rad] stop of the select axis, the same on both sides
  double phi_limit = 35.0 * std::numbers::pi / 180.0;    // [rad] stop of the shift axis, the same on both sides
  bool operator==(const YokeGeometry&) const = default;
};

template <>
inline constexpr Parameter<YokeGeometry> kParameters<YokeGeometry>[] = {
    {&YokeGeometry::radius, "radius", "radius_m", FileRange{0.01, 10.0},
     "Distance from the yoke's centre to the tip. Section 2.2: \"about 120 mm\"."},
    {&YokeGeometry::theta_limit, "theta_limit", "theta_limit_deg", FileRange{0.5, 80.0, file_unit::kDegrees},
     "Stop of the select axis, both sides. Section 2.1."},
    {&YokeGeometry::phi_limit, "phi_limit", "phi_limit_deg", FileRange{0.5, 80.0, file_unit::kDegrees},
     "Stop of the shift axis, both sides. Section 2.1."},
};
static_assert(DescribesAll<YokeGeometry>);

struct JointAngles {
  double theta = 0.0;  // [rad] rotation about Y; positive moves the tip along +select
  double phi = 0.0;    // [rad] rotation about X; positive moves the tip along -shift
};

struct JointTorques {
  double theta = 0.0;  // [N m]
  double phi = 0.0;    // [N m]
};

// Exact position of the tip [m]: eq (2) of the paper with the y component corrected.
glm::dvec3 tip_position(const YokeGeometry& yoke, JointAngles q) noexcept;

// Position of the tip [m] for small angles: eq (3) of the paper. Used only to show the error of this approximation: 3.1
// mm in x and in y if both angles are 20 deg.
glm::dvec3 tip_position_small_angle(const YokeGeometry& yoke, JointAngles q) noexcept;

// Inverse of tip_position(): joint angles [rad] for any point on the upper half of the sphere.
JointAngles joint_angles(glm::dvec3 tip) noexcept;

// The gate lies in the plane (px, py), onto which the tip is projected. plane_position() gives the tip's position in
// this plane [m]. joint_angles_from_plane() gives the angles [rad] for a point with |plane| < radius.
glm::dvec2 plane_position(const YokeGeometry& yoke, JointAngles q) noexcept;
JointAngles joint_angles_from_plane(const YokeGeometry& yoke, glm::dvec2 plane) noexcept;

// Reach of the tip [m] along each axis of the gate plane while the other joint is upright: rho sin(limit). The
// workspace is not a rectangle: a point off both axes needs the larger angles atan2(px, pz) and atan2(-py, pz), where
// pz is the tip's height.
glm::dvec2 workspace_half_extent(const YokeGeometry& yoke) noexcept;

// Position as arc lengths [m], one per axis: (rho theta, -rho phi). plant.h uses these coordinates.
glm::dvec2 arc_position(const YokeGeometry& yoke, JointAngles q) noexcept;

// Force at the tip [N], tangential to the sphere, for given joint torques: eq (5) of the paper, corrected.
glm::dvec3 tip_force(const YokeGeometry& yoke, JointAngles q, JointTorques torque) noexcept;

// Force at the tip [N] for small angles: eq (6) of the paper.
glm::dvec2 tip_force_small_angle(const YokeGeometry& yoke, JointTorques torque) noexcept;

// Like tip_force(), and its inverse (tau = J^T f), but for generalised forces in the gate plane (fz = 0), whose work is
// f . d(px, py). Forces in [N], torques in [N m].
glm::dvec2 plane_force(const YokeGeometry& yoke, JointAngles q, JointTorques torque) noexcept;
JointTorques joint_torques_from_plane(const YokeGeometry& yoke, JointAngles q, glm::dvec2 force) noexcept;

}  // namespace gearshift::haptics
