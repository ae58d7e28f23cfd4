// Builds meshes from triangles and adds them to a model.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/cabin/stage/polygon.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

struct MeshData {
  std::vector<engine::Vertex> vertices;
  std::vector<std::uint32_t> indices;  // three per triangle, counter-clockwise as seen from outside
};

std::uint32_t linear_rgba(glm::vec3 colour) noexcept;  // packs an opaque linear colour for Vertex::colour

// Converts plate coordinates (select, shift) and a height to cabin axes: x right, y up, z back.
glm::vec3 above(glm::dvec2 plate, double height) noexcept;

// Adds horizontal triangles that are visible from above. corners: three per triangle, counter-clockwise.
void add_flat(MeshData& mesh_data, std::span<const glm::dvec2> corners, double height, std::uint32_t colour);

// The upper or lower horizontal edge of a wall.
struct Rim {
  const Loop& loop;
  double height;  // [m]
  std::uint32_t colour = 0xffffffffu;
};
enum class WallFace { from_left, from_right };
// Adds a wall between two loops with equal numbers of points. The wall is visible from the left or from the right of
// the direction of `top`. Neighbouring faces that differ by less than 40 deg get smooth shading.
void add_wall(MeshData& mesh_data, Rim top, Rim bottom, WallFace visible_side);

// The triangles of a mesh that share a material.
struct MaterialPart {
  const MeshData& mesh_data;
  int material = engine::kNone;
};
// Adds a mesh and returns its index. Parts without triangles are left out.
int add_mesh(engine::Model& model, std::string name, std::span<const MaterialPart> parts);

// Adds the mesh with a new node and returns the node's index.
int add_mesh_node(engine::Model& model, std::string name, std::span<const MaterialPart> parts, glm::vec3 translation,
                  int parent);

}  // namespace gearshift::cabin
