#include "app/cabin/stage/pointer_beam.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>

#include "app/cabin/stage/mesh_builder.h"

namespace gearshift::cabin {
namespace {

constexpr double kStickRadius = 0.002, kBallRadius = 0.004;  // [m]
constexpr int kAround = 8;
constexpr glm::vec3 kBeamLight{0.10f, 0.50f, 0.70f};  // emission

// Makes a solid of revolution about z. outline: pairs of radius and z [m], from front (-z) to back.
MeshData turned_body(std::span<const glm::dvec2> outline) {
  MeshData body;
  for (const glm::dvec2 ring : outline) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      engine::Vertex vertex;
      vertex.position = glm::vec3(ring.x * std::cos(angle), ring.x * std::sin(angle), ring.y);
      vertex.normal = glm::vec3(std::cos(angle), std::sin(angle), 0.0);
      body.vertices.push_back(vertex);
    }
  }
  for (std::uint32_t a = 0; a + kAround < body.vertices.size(); ++a) {
    const std::uint32_t b = a % kAround + 1 < kAround ? a + 1 : a + 1 - kAround;
    body.indices.insert(body.indices.end(), {a, b, b + kAround, a, b + kAround, a + kAround});
  }
  return body;
}

MeshData ball() {
  constexpr int kRings = 5;
  std::array<glm::dvec2, kRings> outline;
  for (int i = 0; i < kRings; ++i) {
    const double angle = std::numbers::pi * i / (kRings - 1);
    outline[static_cast<std::size_t>(i)] = kBallRadius * glm::dvec2(std::sin(angle), -std::cos(angle));
  }
  return turned_body(outline);
}

}  // namespace

void add_pointer_beam(engine::Model& model) {
  engine::Material light;
  light.name = kBeamNode;
  light.base_colour = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  light.metallic = 0.0f;
  light.emissive = kBeamLight;
  model.materials.push_back(std::move(light));
  const int material = static_cast<int>(model.materials.size()) - 1;
  constexpr std::array<glm::dvec2, 2> kStick{{{kStickRadius, -1.0}, {kStickRadius, 0.0}}};
  const MeshData stick = turned_body(kStick), end = ball();
  add_mesh_node(model, kBeamNode, std::array{MaterialPart{stick, material}}, glm::vec3(0.0f), engine::kNone);
  add_mesh_node(model, kBeamEndNode, std::array{MaterialPart{end, material}}, glm::vec3(0.0f), engine::kNone);
}

void place_beam_stick(const Beam& beam, engine::Node& stick) {
  const glm::dvec3 along = beam.to - beam.from;
  const double length = glm::length(along);
  stick.translation = glm::vec3(beam.from);
  stick.scale.z = static_cast<float>(length);
  stick.rotation = glm::quat(glm::rotation(glm::dvec3(0.0, 0.0, -1.0), along / length));
}

}  // namespace gearshift::cabin
