#include "app/cabin/stage/shift_light.h"

#include <array>

#include "app/cabin/stage/mesh_builder.h"
#include "app/cabin/stage/mesh_parts.h"

namespace gearshift::cabin {
namespace {

constexpr glm::vec3 kOffPanel{0.0f, 0.0285f, 0.0006f};                          // [m] offset from the gear display
constexpr glm::vec3 kGreen{0.02f, 0.42f, 0.06f}, kAmber{0.55f, 0.14f, 0.005f};  // emission

// Corners [m] of an upward arrow, as counter-clockwise triangles: one for the head, two for the shaft.
constexpr glm::vec2 kArrow[] = {{-0.0062f, 0.0f},     {0.0062f, 0.0f},     {0.0f, 0.0060f},
                                {-0.0024f, -0.0055f}, {0.0024f, -0.0055f}, {0.0024f, 0.0f},
                                {-0.0024f, -0.0055f}, {0.0024f, 0.0f},     {-0.0024f, 0.0f}};

// An arrow that faces the driver. direction: +1 points up, -1 points down (turned by 180 deg).
MeshData arrow(float direction) {
  MeshData mesh_data;
  for (const glm::vec2 corner : kArrow) {
    engine::Vertex vertex;
    vertex.position = {direction * corner, 0.0f};
    mesh_data.indices.push_back(static_cast<std::uint32_t>(mesh_data.vertices.size()));
    mesh_data.vertices.push_back(vertex);
  }
  return mesh_data;
}

void add_arrow(engine::Model& model, const engine::Node& panel, const char* name, float direction, glm::vec3 light) {
  engine::Material material;
  material.name = name;
  material.base_colour = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  material.metallic = 0.0f;
  material.emissive = light;
  model.materials.push_back(std::move(material));
  const MeshData face = arrow(direction);
  const std::array<MaterialPart, 1> parts{MaterialPart{face, static_cast<int>(model.materials.size()) - 1}};
  const int node = add_mesh_node(model, name, parts, panel.translation + panel.rotation * kOffPanel, panel.parent);
  model.nodes[static_cast<std::size_t>(node)].rotation = panel.rotation;
}

}  // namespace

void add_shift_light(engine::Model& model) {
  const engine::Node panel = model.nodes[static_cast<std::size_t>(required_node(model, "GearPanel"))];
  add_arrow(model, panel, kShiftUp, 1.0f, kGreen);
  add_arrow(model, panel, kShiftDown, -1.0f, kAmber);
}

}  // namespace gearshift::cabin
