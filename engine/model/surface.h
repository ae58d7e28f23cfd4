// The triangles of one primitive, and what a file may leave to its reader: lists out of strips, normals, tangents.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/model/model.h"

namespace gearshift {

struct Surface {
  std::vector<Vertex> vertices;
  std::vector<VertexJoints> joints;    // one a vertex, or none
  std::vector<std::uint32_t> indices;  // three a triangle, each below vertices.size()
};

enum class TriangleMode : int { list = 4, strip = 5, fan = 6 };  // as glTF counts
std::vector<std::uint32_t> triangle_list(const std::vector<std::uint32_t>& indices, TriangleMode mode);

// One vertex a corner, with its triangle's normal; a triangle without area gets +Z.
void make_flat_normals(Surface& surface);

// Every normal of length 1; one without length becomes the mean of its triangles' normals, by area.
void mend_normals(Surface& surface);

// From positions, normals and the UV coordinates that the map uses; mirrored and plain triangles share no vertex after.
void make_tangents(Surface& surface, const TextureUse& normal_map);

// Every tangent of length 1 and across its normal, its sign 1 or -1.
void mend_tangents(Surface& surface);

}  // namespace gearshift
