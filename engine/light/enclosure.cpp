#include "engine/light/enclosure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "engine/light/cube.h"

namespace gearshift::engine {

namespace {

constexpr int kWindowSide = 16;  // [texels] face side of the cube map over which the windows are integrated
constexpr int kLiningSide = 4;   // [texels] face side of the cube map for the smooth light that the windows cast

// A window of the car, in ranges [deg] of azimuth (0 ahead, 90 to the right) and elevation. The left side mirrors the
// right.
struct Pane {
  float from, to;  // [deg] azimuth of a window on the right side
  float low, high;
};

// Windows as seen from the point (0.335, 0.56, -0.12) [m] in cabin.glb, between the heads and the lever: windscreen,
// doors, and rear window between the headrests (tests/picture/cabin_light_test.cpp compares them with rays).
constexpr Pane kPanes[] = {{0.0f, 24.0f, -9.0f, 38.0f},
                           {24.0f, 54.0f, -9.0f, 28.0f},
                           {61.0f, 122.0f, -9.0f, 25.0f},
                           {155.0f, 180.0f, -3.0f, 12.0f}};
constexpr glm::vec3 kAbove{0.57f, 0.54f, 0.49f};     // albedo above the window sills: headliner, pillars
constexpr glm::vec3 kBelow{0.060f, 0.058f, 0.055f};  // albedo below the window sills: dash, seats, doors, carpet
constexpr float kSill = -9.0f;                       // [deg] elevation of the window sills

// A direction and the solid angle [sr] that it represents.
struct Ray {
  glm::vec3 direction;
  float angle = 0.0f;
};
std::vector<Ray> cube_rays(int side) {
  std::vector<Ray> rays;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        rays.push_back({cube_direction(face, side, x, y), static_cast<float>(cube_texel_angle(side, x, y))});
  return rays;
}

// Irradiance divided by pi that reaches the lining (inner surface) of the room before any reflection there.
class DirectLight {
 public:
  DirectLight(const Enclosure& room, const Radiance& open, glm::vec3 towards_sun, glm::vec3 irradiance)
      : window_(room.window), towards_sun_(towards_sun), sun_(irradiance / glm::pi<float>()) {
    std::vector<Ray> windows;
    for (const Ray& ray : cube_rays(kWindowSide))
      if (room.window(ray.direction)) windows.push_back(ray);
    const auto from_windows = [&](glm::vec3 at) {
      glm::vec3 sum(0.0f);
      for (const Ray& window : windows) {
        const glm::vec3 to_window = window.direction - at;
        const float length = glm::length(to_window);
        if (length > 1e-3f) sum += window.angle * open(to_window / length);
      }
      return sum / (4.0f * glm::pi<float>());
    };
    sky_ = project(from_windows, kLiningSide);
  }

  glm::vec3 operator()(glm::vec3 at) const {
    glm::vec3 light = glm::max(sky_(at), glm::vec3(0.0f));
    const float slant = -glm::dot(at, towards_sun_);
    if (slant > 0.0f && window_(at + 2.0f * slant * towards_sun_)) light += slant * sun_;
    return light;
  }

 private:
  std::function<bool(glm::vec3)> window_;
  glm::vec3 towards_sun_, sun_;
  Harmonics sky_;
};

}  // namespace

Radiance indoor_radiance(const Enclosure& room, const Radiance& open, glm::vec3 towards_sun, glm::vec3 irradiance) {
  const DirectLight direct(room, open, glm::normalize(towards_sun), irradiance);
  glm::vec3 first_bounce(0.0f), albedo(0.0f);
  for (const Ray& ray : cube_rays(kWindowSide)) {
    if (room.window(ray.direction)) continue;
    const glm::vec3 weight = ray.angle / (4.0f * glm::pi<float>()) * room.albedo(ray.direction);
    first_bounce += weight * direct(ray.direction);
    albedo += weight;
  }
  const glm::vec3 interreflected = first_bounce / (1.0f - albedo);
  return [=](glm::vec3 direction) {
    if (room.window(direction)) return open(direction);
    return room.albedo(direction) * (direct(direction) + interreflected);
  };
}

Enclosure car_cabin() {
  const auto height_of = [](float elevation) { return std::sin(glm::radians(elevation)); };
  struct Opening {
    float from, to, low, high;  // `from`, `to`: azimuth [deg]; `low`, `high`: heights on the unit sphere
  };
  std::vector<Opening> openings;
  for (const Pane& pane : kPanes) openings.push_back({pane.from, pane.to, height_of(pane.low), height_of(pane.high)});
  const auto is_window = [=](glm::vec3 d) {
    const auto at_height = [&](const Opening& opening) { return d.y >= opening.low && d.y < opening.high; };
    if (std::none_of(openings.begin(), openings.end(), at_height)) return false;  // avoids a slow atan2
    const float azimuth = glm::degrees(std::atan2(std::abs(d.x), -d.z));
    return std::any_of(openings.begin(), openings.end(), [&](const Opening& opening) {
      return at_height(opening) && azimuth >= opening.from && azimuth <= opening.to;
    });
  };
  const float sill = height_of(kSill);
  return {is_window, [=](glm::vec3 d) { return d.y > sill ? kAbove : kBelow; }};
}

}  // namespace gearshift::engine
