// Triangles made by hand, on their way into a model.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/stage/polygon.h"
#include "engine/model/model.h"

namespace gearshift {

struct Patch {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise from outside
};

std::uint32_t linear_rgba(glm::vec3 colour) noexcept;  // as Vertex::colour, opaque

// Plate coordinates (select, shift) at a height, in the cabin's axes: x right, y up, z back.
glm::vec3 above(glm::dvec2 plate, double height) noexcept;

// Flat triangles at a height, seen from above. corners: three each, counter-clockwise.
void add_flat(Patch& patch, std::span<const glm::dvec2> corners, double height, std::uint32_t colour);

// Wall between two loops of equally many points, seen from the left side of `top` as it runs, or from the right.
// Smooth where neighbouring faces turn by less than 40 deg.
struct Rim {
  const Loop& loop;
  double height;  // [m]
  std::uint32_t colour = 0xffffffffu;
};
enum class Seen { from_left, from_right };
void add_wall(Patch& patch, Rim top, Rim bottom, Seen seen);

// A new mesh of pieces, one a material. Returns it. A piece without triangles is left out.
struct MeshPiece {
  const Patch& patch;
  int material = kNone;
};
int add_mesh(Model& model, std::string name, std::span<const MeshPiece> pieces);

// The same at a new node. Returns the node.
int add_mesh_node(Model& model, std::string name, std::span<const MeshPiece> pieces, glm::vec3 translation, int parent);

}  // namespace gearshift
