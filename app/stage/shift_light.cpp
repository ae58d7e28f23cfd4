#include "app/stage/shift_light.h"

#include <array>

#include "app/stage/patch.h"
#include "app/stage/pieces.h"

namespace gearshift {
namespace {

constexpr glm::vec3 kOffPanel{0.0f, 0.0285f, 0.0006f};                          // [m] between the indicators' lamps
constexpr glm::vec3 kGreen{0.02f, 0.42f, 0.06f}, kAmber{0.55f, 0.14f, 0.005f};  // emission

// Corners of the arrow that points up, counter-clockwise: its head, then its shaft as two triangles. [m]
constexpr glm::vec2 kArrow[] = {{-0.0062f, 0.0f},     {0.0062f, 0.0f},     {0.0f, 0.0060f},
                                {-0.0024f, -0.0055f}, {0.0024f, -0.0055f}, {0.0024f, 0.0f},
                                {-0.0024f, -0.0055f}, {0.0024f, 0.0f},     {-0.0024f, 0.0f}};

// A face towards the driver. way: +1 up, -1 down, by half a turn.
Patch arrow(float way) {
  Patch patch;
  for (const glm::vec2 corner : kArrow) {
    Vertex vertex;
    vertex.position = {way * corner, 0.0f};
    patch.indices.push_back(static_cast<std::uint32_t>(patch.vertices.size()));
    patch.vertices.push_back(vertex);
  }
  return patch;
}

void add_arrow(Model& model, const Node& panel, const char* name, float way, glm::vec3 light) {
  Material material;
  material.name = name;
  material.base_colour = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
  material.metallic = 0.0f;
  material.emissive = light;
  model.materials.push_back(std::move(material));
  const Patch face = arrow(way);
  const std::array<MeshPiece, 1> pieces{MeshPiece{face, static_cast<int>(model.materials.size()) - 1}};
  const int node = add_mesh_node(model, name, pieces, panel.translation + panel.rotation * kOffPanel, panel.parent);
  model.nodes[static_cast<std::size_t>(node)].rotation = panel.rotation;
}

}  // namespace

void add_shift_light(Model& model) {
  const Node panel = model.nodes[static_cast<std::size_t>(needed_node(model, "GearPanel"))];
  add_arrow(model, panel, kShiftUp, 1.0f, kGreen);
  add_arrow(model, panel, kShiftDown, -1.0f, kAmber);
}

}  // namespace gearshift
