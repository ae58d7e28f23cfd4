// This work is based on:
// Khronos Group. glTF 2.0 Specification. 3.7.2 Meshes. 2021
// Morten S. Mikkelsen. Simulation of Wrinkled Surfaces Revisited (appendix: tangent space). 2008
#include "engine/model/surface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <glm/geometric.hpp>

namespace gearshift::engine {

using glm::vec2;
using glm::vec3;

namespace {

// Normalises v, or returns false if its length is near zero. Uses double, since the squares of floats may overflow a
// float.
bool normalize_in_place(vec3& v) {
  const double length = std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z);
  if (!(length > 1e-30) || !std::isfinite(length)) return false;
  v = vec3(static_cast<float>(v.x / length), static_cast<float>(v.y / length), static_cast<float>(v.z / length));
  return true;
}

// Returns an arbitrary unit vector perpendicular to the unit vector n.
vec3 perpendicular(vec3 n) {
  const vec3 axis = std::abs(n.x) < 0.7f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
  vec3 t = glm::cross(axis, n);
  normalize_in_place(t);
  return t;
}

struct Corners {
  const Vertex& a;
  const Vertex& b;
  const Vertex& c;
};

Corners corners_at(const Surface& s, std::size_t first) {
  return {s.vertices[s.indices[first]], s.vertices[s.indices[first + 1]], s.vertices[s.indices[first + 2]]};
}

vec3 area_normal(const Corners& t) {
  return glm::cross(t.b.position - t.a.position, t.c.position - t.a.position);
}

void unweld(Surface& s) {
  std::vector<Vertex> vertices;
  std::vector<VertexJoints> joints;
  vertices.reserve(s.indices.size());
  for (const std::uint32_t i : s.indices) {
    vertices.push_back(s.vertices[i]);
    if (!s.joints.empty()) joints.push_back(s.joints[i]);
  }
  s.vertices = std::move(vertices);
  s.joints = std::move(joints);
  for (std::size_t i = 0; i < s.indices.size(); ++i) s.indices[i] = static_cast<std::uint32_t>(i);
}

vec2 uv_of(const Vertex& v, const TextureUse& use, const glm::mat3& matrix) {
  return vec2(matrix * vec3(use.uv_set == 0 ? v.uv0 : v.uv1, 1.0f));
}

// Orientation of the texture on a triangle: the direction in which u grows, and whether the texture is mirrored.
struct TextureFrame {
  vec3 along_u{0.0f};
  bool valid = false;
  bool mirrored = false;
};

TextureFrame texture_frame(const Corners& t, const TextureUse& use, const glm::mat3& matrix) {
  const vec2 uv = uv_of(t.a, use, matrix);
  const vec2 d1 = uv_of(t.b, use, matrix) - uv, d2 = uv_of(t.c, use, matrix) - uv;
  const vec3 e1 = t.b.position - t.a.position, e2 = t.c.position - t.a.position;
  const float area = d1.x * d2.y - d2.x * d1.y;  // negative for a texture that is not mirrored: v grows downwards
  TextureFrame frame{(e1 * d2.y - e2 * d1.y) * (area < 0.0f ? -1.0f : 1.0f), false, area > 0.0f};
  frame.valid = area != 0.0f && normalize_in_place(frame.along_u);
  return frame;
}

// Accumulates tangents per vertex. Vertices shared by a mirrored and an unmirrored triangle are duplicated, because one
// tangent cannot serve both.
class TangentSum {
 public:
  explicit TangentSum(Surface& surface)
      : surface_(surface), sum_(surface.vertices.size(), vec3(0.0f)), sign_(surface.vertices.size(), 0) {}

  // Adds a corner's contribution to its vertex: the direction in which u grows on the triangle, projected into the
  // vertex's tangent plane and weighted by the angle at the corner.
  void add(std::size_t corner, const TextureFrame& frame, float angle) {
    const std::uint32_t vertex = vertex_for(corner, frame.mirrored ? -1 : 1);
    const vec3 n = surface_.vertices[vertex].normal;
    vec3 t = frame.along_u - n * glm::dot(n, frame.along_u);
    if (normalize_in_place(t)) sum_[vertex] += angle * t;
  }

  void store() {
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      surface_.vertices[i].tangent = glm::vec4(sum_[i], sign_[i] < 0 ? -1.0f : 1.0f);
    }
  }

 private:
  std::uint32_t vertex_for(std::size_t corner, int sign) {
    const std::uint32_t vertex = surface_.indices[corner];
    if (sign_[vertex] == 0) sign_[vertex] = sign;
    if (sign_[vertex] == sign) return vertex;
    const auto [duplicate, is_new] = duplicates_.try_emplace(vertex, static_cast<std::uint32_t>(sum_.size()));
    if (is_new) {
      surface_.vertices.push_back(Vertex(surface_.vertices[vertex]));
      if (!surface_.joints.empty()) surface_.joints.push_back(VertexJoints(surface_.joints[vertex]));
      sum_.emplace_back(0.0f);
      sign_.push_back(sign);
    }
    surface_.indices[corner] = duplicate->second;
    return duplicate->second;
  }

  Surface& surface_;
  std::vector<vec3> sum_;
  std::vector<int> sign_;  // sign of the bitangent, per vertex; 0: not visited yet
  std::unordered_map<std::uint32_t, std::uint32_t> duplicates_;
};

float angle_between(vec3 a, vec3 b) {
  if (!normalize_in_place(a) || !normalize_in_place(b)) return 0.0f;
  return std::acos(std::clamp(glm::dot(a, b), -1.0f, 1.0f));
}

}  // namespace

std::vector<std::uint32_t> triangle_list(const std::vector<std::uint32_t>& indices, TriangleMode mode) {
  if (mode == TriangleMode::list) return indices;
  std::vector<std::uint32_t> list;
  list.reserve(3 * indices.size());
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {  // glTF 2.0, 3.7.2.1
    if (mode == TriangleMode::strip) {
      list.insert(list.end(), {indices[i], indices[i + (1 + i % 2)], indices[i + (2 - i % 2)]});
    } else {
      list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
    }
  }
  return list;
}

void make_flat_normals(Surface& surface) {
  unweld(surface);
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    vec3 normal = area_normal(corners_at(surface, i));
    if (!normalize_in_place(normal)) normal = vec3(0.0f, 0.0f, 1.0f);
    for (std::size_t corner = i; corner < i + 3; ++corner) surface.vertices[corner].normal = normal;
  }
}

void repair_normals(Surface& surface) {
  std::vector<bool> broken(surface.vertices.size(), false);
  bool any = false;
  for (std::size_t i = 0; i < broken.size(); ++i) {
    if (normalize_in_place(surface.vertices[i].normal)) continue;
    broken[i] = any = true;
    surface.vertices[i].normal = vec3(0.0f);
  }
  if (!any) return;
  for (std::size_t i = 0; i < surface.indices.size(); ++i) {
    Vertex& vertex = surface.vertices[surface.indices[i]];
    if (broken[surface.indices[i]]) vertex.normal += area_normal(corners_at(surface, i - i % 3));
  }
  for (std::size_t i = 0; i < broken.size(); ++i) {
    vec3& normal = surface.vertices[i].normal;
    if (broken[i] && !normalize_in_place(normal)) normal = vec3(0.0f, 0.0f, 1.0f);
  }
}

void make_tangents(Surface& surface, const TextureUse& normal_map) {
  const glm::mat3 matrix = normal_map.matrix();
  TangentSum sum(surface);
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const Corners t = corners_at(surface, i);
    const TextureFrame frame = texture_frame(t, normal_map, matrix);
    if (!frame.valid) continue;
    const vec3 ab = t.b.position - t.a.position, bc = t.c.position - t.b.position, ca = t.a.position - t.c.position;
    const float angles[3] = {angle_between(ab, -ca), angle_between(bc, -ab), angle_between(ca, -bc)};
    for (std::size_t k = 0; k < 3; ++k) sum.add(i + k, frame, angles[k]);
  }
  sum.store();
  repair_tangents(surface);
}

void repair_tangents(Surface& surface) {
  for (Vertex& vertex : surface.vertices) {
    vec3 t = vec3(vertex.tangent);
    t -= vertex.normal * glm::dot(vertex.normal, t);
    if (!normalize_in_place(t)) t = perpendicular(vertex.normal);
    vertex.tangent = glm::vec4(t, vertex.tangent.w < 0.0f ? -1.0f : 1.0f);
  }
}

}  // namespace gearshift::engine
