#include "engine/render/shadow_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

namespace gearshift::engine {

namespace {

constexpr int kStepsPerWidth = 16;           // the map's centre moves by multiples of width / kStepsPerWidth
constexpr double kMinWidth = 1e-3;           // [m]
constexpr double kWidthRatio = 1.189207115;  // 2^(1/4), ratio of consecutive map widths
constexpr double kDepthStep = 0.25;          // [m] the depth range is rounded to multiples of kDepthStep

struct Corner {
  glm::vec3 world;
  glm::vec4 clip;
};
using Polygon = std::vector<Corner>;

// Returns the part of the polygon with dot(plane, clip) >= 0 (Ivan Sutherland, Gary Hodgman. Reentrant Polygon
// Clipping. 1974).
Polygon clipped(const Polygon& polygon, glm::vec4 plane) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float in_a = glm::dot(plane, a.clip), in_b = glm::dot(plane, b.clip);
    if (in_a >= 0.0f) inside.push_back(a);
    if ((in_a >= 0.0f) == (in_b >= 0.0f)) continue;
    const float t = in_a / (in_a - in_b);
    inside.push_back({glm::mix(a.world, b.world, t), glm::mix(a.clip, b.clip, t)});
  }
  return inside;
}

// Left, right, top and bottom planes of the view pyramid. The near plane is omitted, so the pyramid extends to its
// apex.
constexpr std::array<glm::vec4, 4> kSides{{{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}, {0, -1, 0, 1}}};

std::array<glm::vec3, 8> corners_of(const Box& box) {
  std::array<glm::vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z};
  return corners;
}

constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};

// The point where all four sides of the view pyramid meet: clip x = y = w = 0.
glm::vec3 apex_of(const glm::mat4& clip_from_world) {
  const glm::mat4 rows = glm::transpose(clip_from_world);
  const glm::mat3 system = glm::transpose(glm::mat3(glm::vec3(rows[0]), glm::vec3(rows[1]), glm::vec3(rows[3])));
  return glm::inverse(system) * -glm::vec3(rows[0].w, rows[1].w, rows[3].w);
}

bool contains(const Box& box, glm::vec3 point) {
  return glm::all(glm::lessThanEqual(box.low, point)) && glm::all(glm::lessThanEqual(point, box.high));
}

}  // namespace

std::vector<glm::vec3> visible_corners(const Box& box, std::span<const glm::mat4> clip_from_world) {
  const std::array<glm::vec3, 8> corners = corners_of(box);
  std::vector<glm::vec3> visible;
  for (const glm::mat4& clip : clip_from_world) {
    for (const auto& face : kFaces) {
      Polygon polygon;
      for (const int corner : face) {
        const glm::vec3 at = corners[static_cast<std::size_t>(corner)];
        polygon.push_back({at, clip * glm::vec4(at, 1.0f)});
      }
      for (const glm::vec4& side : kSides) polygon = clipped(polygon, side);
      for (const Corner& corner : polygon) visible.push_back(corner.world);
    }
    if (const glm::vec3 apex = apex_of(clip); contains(box, apex)) visible.push_back(apex);
  }
  if (visible.empty()) visible.assign(corners.begin(), corners.end());
  return visible;
}

ShadowFit fit_shadow(std::span<const glm::vec3> points, glm::vec3 towards_sun, int side) {
  const glm::dvec3 z = glm::normalize(glm::dvec3(towards_sun));
  const glm::dvec3 not_parallel = std::abs(z.y) < 0.99 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(not_parallel, z)), y = glm::cross(z, x);

  glm::dvec3 low(1e30), high(-1e30);
  for (const glm::vec3& point : points) {
    const glm::dvec3 p(point), in_sun_frame(glm::dot(x, p), glm::dot(y, p), glm::dot(z, p));
    low = glm::min(low, in_sun_frame);
    high = glm::max(high, in_sun_frame);
  }
  // The map is made one step wider than the points, because rounding its centre to whole steps moves it by up to half a
  // step to either side.
  const int inner = side - 2 * kShadowMargin, texels_per_step = std::max(1, inner / kStepsPerWidth);
  const double slack = 1.0 - static_cast<double>(texels_per_step) / inner;
  const double needed = std::max({high.x - low.x, high.y - low.y, kMinWidth}) / slack;
  const double width = std::pow(kWidthRatio, std::ceil(std::log(needed) / std::log(kWidthRatio)));
  const double texel = width / inner, step = texel * texels_per_step, half = 0.5 * texel * side;
  const glm::dvec2 middle = step * glm::round(0.5 * glm::dvec2(low + high) / step);
  const double deepest = kDepthStep * std::floor(low.z / kDepthStep);
  const double highest = kDepthStep * std::ceil(high.z / kDepthStep);
  const double depth_range = highest - deepest + static_cast<double>(kCasterReach);

  glm::dmat4 clip(1.0);
  for (int i = 0; i < 3; ++i) {
    clip[i][0] = x[i] / half;
    clip[i][1] = -y[i] / half;
    clip[i][2] = z[i] / depth_range;
  }
  clip[3] = {-middle.x / half, middle.y / half, -deepest / depth_range, 1.0};

  glm::dmat4 texture(1.0);
  texture[0][0] = texture[1][1] = 0.5;
  texture[3] = {0.5, 0.5, 0.0, 1.0};
  return {glm::mat4(clip), glm::mat4(texture * clip), static_cast<float>(texel)};
}

}  // namespace gearshift::engine
