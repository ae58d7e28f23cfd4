#include "haptics/joystick/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/joystick/plane_pose.h"

using namespace gearshift::haptics;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr YokeGeometry kYoke;

// Calls `check` with joint angles across the whole workspace, corners included.
template <class Check>
void everywhere(Check check) {
  for (int theta = -40; theta <= 40; theta += 8) {
    for (int phi = -35; phi <= 35; phi += 7) check(JointAngles{theta * kDegree, phi * kDegree});
  }
}

// Numeric derivative by a five-point difference with step h; its error is of order h^4.
template <class Map>
auto derivative(Map map, JointAngles q, double dtheta, double dphi) {
  const double h = 1e-3;
  const auto at = [&](double s) { return map(JointAngles{q.theta + s * dtheta, q.phi + s * dphi}); };
  return (at(-2 * h) - 8.0 * at(-h) + 8.0 * at(h) - at(2 * h)) / (12.0 * h);
}

glm::dvec3 d_tip(JointAngles q, double dtheta, double dphi) {
  return derivative([](JointAngles at) { return tip_position(kYoke, at); }, q, dtheta, dphi);
}

glm::dvec2 d_plane(JointAngles q, double dtheta, double dphi) {
  return derivative([](JointAngles at) { return plane_position(kYoke, at); }, q, dtheta, dphi);
}

}  // namespace

TEST_CASE("the tip stays on its sphere: the printed sin(theta) in y of eq (2) would leave it by 20 mm") {
  double printed_error = 0.0;
  everywhere([&](JointAngles q) {
    const glm::dvec3 p = tip_position(kYoke, q);
    CHECK(std::abs(glm::length(p) - 0.120) < 1e-15);
    const glm::dvec3 printed{p.x, p.y * std::tan(q.theta), p.z};
    printed_error = std::max(printed_error, std::abs(glm::length(printed) - 0.120));
  });
  CHECK(printed_error == doctest::Approx(0.020).epsilon(0.1));
}

TEST_CASE("the tip lies along (tan theta, -tan phi, 1), and the inverse finds the angles") {
  everywhere([](JointAngles q) {
    const glm::dvec3 expected = 0.120 * glm::normalize(glm::dvec3(std::tan(q.theta), -std::tan(q.phi), 1.0));
    CHECK(glm::length(tip_position(kYoke, q) - expected) < 1e-15);
    CHECK(glm::length(plane_position(kYoke, q) - glm::dvec2(expected)) < 1e-15);
    const JointAngles back = joint_angles(expected);
    CHECK(std::abs(back.theta - q.theta) + std::abs(back.phi - q.phi) < 1e-14);
    const JointAngles from_plane = joint_angles_from_plane(kYoke, glm::dvec2(expected));
    CHECK(std::abs(from_plane.theta - q.theta) + std::abs(from_plane.phi - q.phi) < 1e-14);
  });
}

TEST_CASE("the reach is no rectangle: 64 mm aside, 61 mm forward takes 36.9 deg of the shift joint's 35") {
  const JointAngles q = joint_angles_from_plane(kYoke, {0.064, 0.061});
  CHECK(-q.phi / kDegree == doctest::Approx(36.9).epsilon(1e-3));
  CHECK(q.theta < kYoke.theta_limit);
  const glm::dvec2 half = workspace_half_extent(kYoke);
  CHECK(half.x > 0.064);
  CHECK(half.y > 0.061);
}

TEST_CASE("small angles, eq (3), miss by 0.41 mm at 10 deg, 3.1 at 20, 13.6 at 35 per component") {
  const double angle[] = {10, 20, 35}, component[] = {0.41, 3.1, 13.6};
  const double plane[] = {0.58, 4.3, 19.0}, space[] = {3.6, 14.0, 40.0};
  for (int i = 0; i < 3; ++i) {
    const JointAngles q{angle[i] * kDegree, angle[i] * kDegree};
    const glm::dvec3 miss = 1e3 * (tip_position_small_angle(kYoke, q) - tip_position(kYoke, q));
    CHECK(std::abs(miss.x) == doctest::Approx(component[i]).epsilon(0.02));
    CHECK(std::abs(miss.y) == doctest::Approx(component[i]).epsilon(0.02));
    CHECK(glm::length(glm::dvec2(miss)) == doctest::Approx(plane[i]).epsilon(0.02));
    CHECK(glm::length(miss) == doctest::Approx(space[i]).epsilon(0.02));
  }
}

TEST_CASE("eq (5) corrected: the tip force is tangential and does the torques' work") {
  everywhere([](JointAngles q) {
    const JointTorques torque{1.3, -0.7};
    const glm::dvec3 f = tip_force(kYoke, q, torque);
    CHECK(std::abs(glm::dot(f, tip_position(kYoke, q))) < 1e-14);
    CHECK(std::abs(glm::dot(f, d_tip(q, 1.0, 0.0)) - torque.theta) < 1e-9);
    CHECK(std::abs(glm::dot(f, d_tip(q, 0.0, 1.0)) - torque.phi) < 1e-9);
  });
}

TEST_CASE("forces in the gate plane do the same work as the torques, in both directions") {
  everywhere([](JointAngles q) {
    const glm::dvec2 f{11.0, -6.0};
    const JointTorques torque = joint_torques_from_plane(kYoke, q, f);
    CHECK(std::abs(torque.theta - glm::dot(f, d_plane(q, 1.0, 0.0))) < 1e-9);
    CHECK(std::abs(torque.phi - glm::dot(f, d_plane(q, 0.0, 1.0))) < 1e-9);
    CHECK(glm::length(plane_force(kYoke, q, torque) - f) < 1e-13);
  });
}

TEST_CASE("between arcs and plane velocities go with the Jacobian, forces with the work") {
  everywhere([](JointAngles q) {
    const PlanePose pose = plane_pose(std::tan(q.theta), std::tan(q.phi));
    CHECK(glm::length(plane_position(pose, 0.120) - plane_position(kYoke, q)) < 1e-15);
    const glm::dvec2 arc{0.3, -0.2};  // [m/s] speeds along the two arcs
    const glm::dvec2 plane = d_plane(q, arc.x / 0.120, -arc.y / 0.120);
    CHECK(glm::length(plane_velocity(pose, arc) - plane) < 1e-9);
    CHECK(glm::length(arc_velocity(pose, plane_velocity(pose, arc)) - arc) < 1e-14);

    const glm::dvec2 f{11.0, -6.0};
    CHECK(std::abs(glm::dot(arc_force(pose, f), arc) - glm::dot(f, plane)) < 1e-9);
    CHECK(glm::length(plane_force(pose, arc_force(pose, f)) - f) < 1e-13);
  });
}

TEST_CASE("the rated torque of 1.3 N m is 10.83 N at the tip, eq (6), and eq (5) agrees at the centre") {
  const JointTorques rated{1.3, -1.3};
  CHECK(tip_force_small_angle(kYoke, rated).x == doctest::Approx(10.833).epsilon(1e-4));
  CHECK(tip_force_small_angle(kYoke, rated).y == doctest::Approx(10.833).epsilon(1e-4));
  const glm::dvec3 exact = tip_force(kYoke, {}, rated);
  CHECK(glm::length(glm::dvec2(exact) - tip_force_small_angle(kYoke, rated)) < 1e-14);
}
