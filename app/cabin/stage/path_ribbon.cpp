#include "app/cabin/stage/path_ribbon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>

#include "app/cabin/stage/lever_pose.h"
#include "app/cabin/stage/mesh_builder.h"

namespace gearshift::cabin {
namespace {

constexpr double kMinPathLength = 1e-4;  // [m] shorter paths are treated as a point

struct MeasuredPath {
  std::vector<glm::dvec2> points;
  std::vector<double> at;  // [m] distance from the start to each point along the path
};

// Computes the distances of the points along the path; drops non-finite and repeated points.
MeasuredPath measure_path(std::span<const glm::dvec2> path) {
  MeasuredPath out;
  for (const glm::dvec2 point : path) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    const double step = out.points.empty() ? 0.0 : glm::distance(out.points.back(), point);
    if (!out.points.empty() && step == 0.0) continue;
    out.at.push_back(out.at.empty() ? 0.0 : out.at.back() + step);
    out.points.push_back(point);
  }
  return out;
}

glm::dvec2 point_at(const MeasuredPath& path, double along) {
  const auto after = std::upper_bound(path.at.begin() + 1, path.at.end() - 1, along);
  const auto i = static_cast<std::size_t>(after - path.at.begin());
  const double fraction = (along - path.at[i - 1]) / (path.at[i] - path.at[i - 1]);
  return glm::mix(path.points[i - 1], path.points[i], std::clamp(fraction, 0.0, 1.0));
}

bool is_gap(const PathStyle& style, double along) {
  return style.gap > 0.0 && std::fmod(along, style.dash + style.gap) > style.dash;
}

// A unit vector across the path and tangential to the sphere on which the knob moves. Where the path reverses its
// direction, returns `last`.
glm::dvec3 side_of(glm::dvec3 before, glm::dvec3 here, glm::dvec3 after, glm::dvec3 last) {
  const glm::dvec3 side = glm::cross(after - before, glm::normalize(here));
  const double length = glm::length(side);
  return length > 1e-9 ? side / length : last;
}

}  // namespace

int add_path(engine::Model& model, const std::string& name, glm::vec3 pivot, const PathStyle& style) {
  engine::Material material;
  material.name = name;
  material.base_colour = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  material.metallic = 0.0f;
  material.emissive = style.light;
  model.materials.push_back(std::move(material));
  MeshData tube;
  tube.vertices.resize(static_cast<std::size_t>(kPathRings) * kPathSides);
  for (std::uint32_t ring = 0; ring + 1 < static_cast<std::uint32_t>(kPathRings); ++ring) {
    for (std::uint32_t side = 0; side < static_cast<std::uint32_t>(kPathSides); ++side) {
      const std::uint32_t next = (side + 1) % kPathSides;
      const std::uint32_t a = ring * kPathSides + side, b = ring * kPathSides + next;
      tube.indices.insert(tube.indices.end(), {a, b + kPathSides, b, a, a + kPathSides, b + kPathSides});
    }
  }
  const std::array<MaterialPart, 1> parts{MaterialPart{tube, static_cast<int>(model.materials.size()) - 1}};
  return add_mesh_node(model, name, parts, pivot, engine::kNone);
}

bool shape_path(std::span<const glm::dvec2> path, const haptics::YokeGeometry& yoke, const PathStyle& style,
                std::vector<engine::Vertex>& out) {
  const MeasuredPath line = measure_path(path);
  if (line.points.size() < 2 || line.at.back() < kMinPathLength) return false;
  std::array<glm::dvec3, kPathRings> knob;
  const double step = line.at.back() / (kPathRings - 1);
  for (std::size_t i = 0; i < knob.size(); ++i) {
    knob[i] = (kDrawnLever + kPathLift) * lever_direction(yoke, point_at(line, static_cast<double>(i) * step));
  }
  out.resize(knob.size() * kPathSides);
  glm::dvec3 side{1.0, 0.0, 0.0};
  for (std::size_t i = 0; i < knob.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == knob.size();
    const double radius = is_end || is_gap(style, static_cast<double>(i) * step) ? 0.0 : style.radius;
    side = side_of(knob[i > 0 ? i - 1 : 0], knob[i], knob[std::min(i + 1, knob.size() - 1)], side);
    const glm::dvec3 up = glm::normalize(knob[i]);
    for (std::size_t k = 0; k < kPathSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kPathSides;
      const glm::dvec3 outwards = std::cos(angle) * side + std::sin(angle) * up;
      engine::Vertex& vertex = out[i * kPathSides + k];
      vertex.position = glm::vec3(knob[i] + radius * outwards);
      vertex.normal = glm::vec3(outwards);
    }
  }
  return true;
}

}  // namespace gearshift::cabin
