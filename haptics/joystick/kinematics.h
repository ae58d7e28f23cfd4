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

namespace gearshift::haptics {

struct YokeGeometry {
  double radius = 0.120;                                 // [m] rho, centre to tip
  double theta_limit = 40.0 * std::numbers::pi / 180.0;  // [rad] stop of the select axis, both sides
  double phi_limit = 35.0 * std::numbers::pi / 180.0;    // [rad] stop of the shift axis, both sides
};

struct JointAngles {
  double theta = 0.0;  // [rad] about Y: moves the tip along +select
  double phi = 0.0;    // [rad] about X: moves the tip along -shift
};

struct JointTorques {
  double theta = 0.0;  // [N m]
  double phi = 0.0;    // [N m]
};

// Exact tip position [m]: the paper's eq (2) with the corrected y component.
glm::dvec3 tip_position(const YokeGeometry& yoke, JointAngles q) noexcept;

// Tip position [m] for small angles: the paper's eq (3). Used only to show its error: 3.1 mm per component at 20 deg.
glm::dvec3 tip_position_small_angle(const YokeGeometry& yoke, JointAngles q) noexcept;

// Inverse of tip_position() for any point on the upper half sphere. [rad]
JointAngles joint_angles(glm::dvec3 tip) noexcept;

// The gate lies in the plane (px, py), onto which the tip is projected: the tip's position there [m], and the angles
// [rad] for a plane point with |plane| < radius.
glm::dvec2 plane_position(const YokeGeometry& yoke, JointAngles q) noexcept;
JointAngles joint_angles_from_plane(const YokeGeometry& yoke, glm::dvec2 plane) noexcept;

// Reach of the tip [m] in the gate plane along each axis with the other joint upright: rho sin(limit). The workspace is
// not a rectangle: a point off both axes needs larger angles, atan2(px, pz) and atan2(-py, pz) with the tip's height
// pz.
glm::dvec2 workspace_half_extent(const YokeGeometry& yoke) noexcept;

// The plant's coordinates: the arc lengths (rho theta, -rho phi), one per axis. [m]
glm::dvec2 arc_position(const YokeGeometry& yoke, JointAngles q) noexcept;

// Force at the tip [N], tangential to the sphere, from the joint torques: the paper's eq (5), corrected.
glm::dvec3 tip_force(const YokeGeometry& yoke, JointAngles q, JointTorques torque) noexcept;

// Inverse of tip_force(), tau = J^T f: joint torques [N m] equivalent to a force at the tip.
JointTorques joint_torques(const YokeGeometry& yoke, JointAngles q, glm::dvec3 force) noexcept;

// Force at the tip [N] for small angles: the paper's eq (6).
glm::dvec2 tip_force_small_angle(const YokeGeometry& yoke, JointTorques torque) noexcept;

// The maps tip_force() and joint_torques() for generalised forces in the gate plane (fz = 0), whose work is f . d(px,
// py). [N], [N m]
glm::dvec2 plane_force(const YokeGeometry& yoke, JointAngles q, JointTorques torque) noexcept;
JointTorques joint_torques_from_plane(const YokeGeometry& yoke, JointAngles q, glm::dvec2 force) noexcept;

}  // namespace gearshift::haptics
