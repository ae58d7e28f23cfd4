#include "app/stage/way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>

#include "app/stage/lever_pose.h"
#include "app/stage/patch.h"

namespace gearshift {
namespace {

constexpr double kLeastLength = 1e-4;  // [m] below, it is a point

struct Measured {
  std::vector<glm::dvec2> points;
  std::vector<double> at;  // [m] along the way; rising
};

// Without points that are no numbers, or lie on the one before.
Measured measured(std::span<const glm::dvec2> way) {
  Measured out;
  for (const glm::dvec2 point : way) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    const double step = out.points.empty() ? 0.0 : glm::distance(out.points.back(), point);
    if (!out.points.empty() && step == 0.0) continue;
    out.at.push_back(out.at.empty() ? 0.0 : out.at.back() + step);
    out.points.push_back(point);
  }
  return out;
}

glm::dvec2 point_at(const Measured& way, double along) {
  const auto after = std::upper_bound(way.at.begin() + 1, way.at.end() - 1, along);
  const auto i = static_cast<std::size_t>(after - way.at.begin());
  const double share = (along - way.at[i - 1]) / (way.at[i] - way.at[i - 1]);
  return glm::mix(way.points[i - 1], way.points[i], std::clamp(share, 0.0, 1.0));
}

bool is_gap(const WayLook& look, double along) {
  return look.gap > 0.0 && std::fmod(along, look.dash + look.gap) > look.dash;
}

// Across the way and level with the knob's sphere; as before where the way turns back on itself.
glm::dvec3 side_of(glm::dvec3 before, glm::dvec3 here, glm::dvec3 after, glm::dvec3 last) {
  const glm::dvec3 side = glm::cross(after - before, glm::normalize(here));
  const double length = glm::length(side);
  return length > 1e-9 ? side / length : last;
}

}  // namespace

int add_way(Model& model, const std::string& name, glm::vec3 pivot, const WayLook& look) {
  Material material;
  material.name = name;
  material.base_colour = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  material.metallic = 0.0f;
  material.emissive = look.light;
  model.materials.push_back(std::move(material));
  Patch tube;
  tube.vertices.resize(static_cast<std::size_t>(kWayRings) * kWaySides);
  for (std::uint32_t ring = 0; ring + 1 < static_cast<std::uint32_t>(kWayRings); ++ring) {
    for (std::uint32_t side = 0; side < static_cast<std::uint32_t>(kWaySides); ++side) {
      const std::uint32_t next = (side + 1) % kWaySides;
      const std::uint32_t a = ring * kWaySides + side, b = ring * kWaySides + next;
      tube.indices.insert(tube.indices.end(), {a, b + kWaySides, b, a, a + kWaySides, b + kWaySides});
    }
  }
  const std::array<MeshPiece, 1> pieces{MeshPiece{tube, static_cast<int>(model.materials.size()) - 1}};
  return add_mesh_node(model, name, pieces, pivot, kNone);
}

bool shape_way(std::span<const glm::dvec2> way, const YokeGeometry& yoke, const WayLook& look,
               std::vector<Vertex>& out) {
  const Measured line = measured(way);
  if (line.points.size() < 2 || line.at.back() < kLeastLength) return false;
  std::array<glm::dvec3, kWayRings> knob;
  const double step = line.at.back() / (kWayRings - 1);
  for (std::size_t i = 0; i < knob.size(); ++i) {
    knob[i] = (kDrawnLever + kWayLift) * lever_direction(yoke, point_at(line, static_cast<double>(i) * step));
  }
  out.resize(knob.size() * kWaySides);
  glm::dvec3 side{1.0, 0.0, 0.0};
  for (std::size_t i = 0; i < knob.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == knob.size();
    const double radius = is_end || is_gap(look, static_cast<double>(i) * step) ? 0.0 : look.radius;
    side = side_of(knob[i > 0 ? i - 1 : 0], knob[i], knob[std::min(i + 1, knob.size() - 1)], side);
    const glm::dvec3 up = glm::normalize(knob[i]);
    for (std::size_t k = 0; k < kWaySides; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kWaySides;
      const glm::dvec3 outwards = std::cos(angle) * side + std::sin(angle) * up;
      Vertex& vertex = out[i * kWaySides + k];
      vertex.position = glm::vec3(knob[i] + radius * outwards);
      vertex.normal = glm::vec3(outwards);
    }
  }
  return true;
}

}  // namespace gearshift
