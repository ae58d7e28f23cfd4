// Compares views with pinhole geometry that is computed without matrices.
#include "engine/scene/view.h"

#include <cmath>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

using namespace gearshift::engine;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double kNear = 0.05;
const dvec2 kSize{1280.0, 720.0};

// Returns the pixel [px] at which a pinhole camera shows the point: where the ray from the eye to the point crosses the
// picture.
dvec2 pinhole(const EyePose& eye, const Fov& fov, dvec3 point) {
  const dvec3 to = point - eye.position;
  const double ahead = glm::dot(to, eye.orientation * dvec3(0.0, 0.0, -1.0));
  const double right = glm::dot(to, eye.orientation * dvec3(1.0, 0.0, 0.0)) / ahead;
  const double up = glm::dot(to, eye.orientation * dvec3(0.0, 1.0, 0.0)) / ahead;
  return {kSize.x * (right - std::tan(fov.left)) / (std::tan(fov.right) - std::tan(fov.left)),
          kSize.y * (std::tan(fov.up) - up) / (std::tan(fov.up) - std::tan(fov.down))};
}

}  // namespace

TEST_CASE("points are projected within 0.1 px of a pinhole, for each eye of any head") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const dvec3 head{2.0 * unit(random), 1.0 + unit(random), 2.0 * unit(random)};
    const EyePose pose = look_at(head, head + dvec3(unit(random), 0.5 * unit(random), -1.5));
    const Fov centre{-0.8 + 0.2 * unit(random), 0.9, -0.6, 0.7 + 0.2 * unit(random)};
    const StereoEyes eyes = stereo_eyes(pose, centre, 0.064, 0.7);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const double ahead = 0.1 + 50.0 * std::abs(unit(random));
      const dvec3 point =
          head + pose.orientation * dvec3(0.8 * ahead * unit(random), 0.6 * ahead * unit(random), -ahead);
      const View view = view_from(eyes.pose[eye], eyes.fov[eye], kNear);
      const dvec3 projected = project(view, point, kSize);
      worst = std::max(worst, glm::length(dvec2(projected) - pinhole(eyes.pose[eye], eyes.fov[eye], point)));
      CHECK(projected.z == doctest::Approx(ahead - kNear).epsilon(1e-4));
    }
  }
  MESSAGE("worst " << worst << " px");
  CHECK(worst < 0.1);
}

TEST_CASE("disparity is f ipd (1 / z - 1 / distance)") {
  const double ipd = 0.063, distance = 0.8;
  const EyePose head = look_at({0.1, 1.2, 0.3}, {0.1, 1.2, -5.0});
  const Fov fov = symmetric_fov(1.2, kSize.x / kSize.y);
  const double focal = 0.5 * kSize.y / std::tan(0.6);  // [px]
  const StereoEyes eyes = stereo_eyes(head, fov, ipd, distance);
  for (const double z : {0.2, 0.4, 0.8, 1.6, 30.0}) {
    const dvec3 point = head.position + dvec3(0.05, -0.02, -z);
    double x[2];
    for (std::size_t eye = 0; eye < 2; ++eye)
      x[eye] = project(view_from(eyes.pose[eye], eyes.fov[eye], kNear), point, kSize).x;
    CHECK(x[0] - x[1] == doctest::Approx(focal * ipd * (1.0 / z - 1.0 / distance)).epsilon(1e-4));
  }
}

TEST_CASE("depth is 1 at the near plane, falls as near plane / z, and is 0 at infinity") {
  const glm::mat4 clip = off_axis_projection(symmetric_fov(1.0, 1.5), kNear);
  for (const double z : {kNear, 0.1, 1.0, 1e3, 1e6}) {
    const glm::vec4 at = clip * glm::vec4(0.0f, 0.0f, static_cast<float>(-z), 1.0f);
    CHECK(at.z / at.w == doctest::Approx(kNear / z).epsilon(1e-6));
  }
  const glm::vec4 far_away = clip * glm::vec4(0.0f, 0.0f, -1.0f, 0.0f);
  CHECK(far_away.z == 0.0f);
  CHECK(far_away.w > 0.0f);
}

TEST_CASE("points behind the eye or nearer than the near plane have a negative depth") {
  const View view = view_from(look_at({0, 0, 0}, {0, 0, -1}), symmetric_fov(1.0, 1.0), kNear);
  CHECK(project(view, {0.0, 0.0, -2.0 * kNear}, kSize).z > 0.0);
  CHECK(project(view, {0.0, 0.0, -0.5 * kNear}, kSize).z < 0.0);
  CHECK(project(view, {0.0, 0.0, 1.0}, kSize).z < 0.0);
}

TEST_CASE("up is up in the picture, right is right, and the target is at the centre") {
  for (const dvec3 target : {dvec3(0, 0, -3), dvec3(3, 0, 0), dvec3(-1, 2, 2), dvec3(0, -3, 0), dvec3(0, 3, 0)}) {
    const EyePose pose = look_at({0, 0, 0}, target);
    const View view = view_from(pose, symmetric_fov(1.0, kSize.x / kSize.y), kNear);
    const dvec3 middle = project(view, target, kSize);
    CHECK(middle.x == doctest::Approx(0.5 * kSize.x));
    CHECK(middle.y == doctest::Approx(0.5 * kSize.y));
    CHECK(project(view, target + pose.orientation * dvec3(0.0, 0.1, 0.0), kSize).y < middle.y);
    CHECK(project(view, target + pose.orientation * dvec3(0.1, 0.0, 0.0), kSize).x > middle.x);
    CHECK(glm::length(pose.orientation) == doctest::Approx(1.0));
  }
  const EyePose level = look_at({0, 0, 0}, {1, 0.3, -1});
  CHECK(project(view_from(level, symmetric_fov(1.0, 1.0), kNear), {1, 0.5, -1}, kSize).y < 0.5 * kSize.y);
}

TEST_CASE("a symmetric field of view has the aspect of its picture") {
  const Fov fov = symmetric_fov(glm::radians(60.0), 16.0 / 9.0);
  CHECK(fov.up - fov.down == doctest::Approx(glm::radians(60.0)));
  CHECK(std::tan(fov.right) / std::tan(fov.up) == doctest::Approx(16.0 / 9.0));
  CHECK(fov.left == -fov.right);
}
