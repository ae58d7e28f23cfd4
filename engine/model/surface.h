// The triangles of one primitive. The functions convert strips and fans to triangle lists, and compute missing normals
// and tangents, as glTF requires.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/model/model.h"

namespace gearshift::engine {

struct Surface {
  std::vector<Vertex> vertices;
  std::vector<VertexJoints> joints;    // one per vertex, or empty
  std::vector<std::uint32_t> indices;  // three per triangle, each below vertices.size()
};

enum class TriangleMode : int { list = 4, strip = 5, fan = 6 };  // glTF's values
std::vector<std::uint32_t> triangle_list(const std::vector<std::uint32_t>& indices, TriangleMode mode);

// Gives each corner of a triangle its own vertex, with the triangle's normal. A triangle without area gets the normal
// +Z.
void make_flat_normals(Surface& surface);

// Normalises every normal. A normal of zero length becomes the area-weighted mean of the adjacent triangles' normals.
void repair_normals(Surface& surface);

// Computes tangents from positions, normals and the UV set of the normal map. Afterwards no vertex belongs to both a
// triangle with a mirrored texture and one with an unmirrored texture.
void make_tangents(Surface& surface, const TextureUse& normal_map);

// Makes every tangent a unit vector perpendicular to its normal, with a sign of 1 or -1.
void repair_tangents(Surface& surface);

}  // namespace gearshift::engine
