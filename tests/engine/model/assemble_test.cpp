// Combining and merging models must not change anything visible.
#include "engine/model/assemble.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>
#include <set>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/model/gltf.h"
#include "tests/engine/model/model_laws.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using glm::vec3;
using glm::vec4;

namespace {

// A corner in world space: position, normal, tangent, bitangent, UV and colour, rounded to thousandths. The random
// models below use multiples of 1/8 and of a quarter turn, so no value is close to a rounding boundary.
using Corner = std::array<long, 15>;
using Triangle = std::pair<int, std::array<Corner, 3>>;  // material and corners

Corner world_corner(const Vertex& v, const glm::mat4& world) {
  const glm::mat3 linear(world);
  const vec3 bitangent = glm::cross(v.normal, vec3(v.tangent)) * v.tangent.w;
  // The transforms of these models map axes to axes, so normals need no inverse transpose.
  const vec3 vectors[] = {vec3(world * vec4(v.position, 1.0f)), glm::normalize(linear * v.normal),
                          glm::normalize(linear * vec3(v.tangent)), glm::normalize(linear * bitangent)};
  Corner corner{};
  std::size_t next = 0;
  for (const vec3& vector : vectors) {
    for (int i = 0; i < 3; ++i) corner[next++] = std::lround(vector[i] * 1000.0f);
  }
  corner[next++] = std::lround(v.uv0.x * 1000.0f);
  corner[next++] = std::lround(v.uv1.y * 1000.0f);
  corner[next++] = static_cast<long>(v.colour);
  return corner;
}

// All triangles in world space, sorted. A triangle may start at any corner, but its winding matters; a mirroring
// transform reverses the winding.
std::vector<Triangle> sorted_triangles(const Model& model) {
  std::vector<Triangle> triangles;
  const std::vector<glm::mat4> world = rest_pose(model);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    if (model.nodes[n].mesh == kNone) continue;
    const bool mirrored = glm::determinant(glm::mat3(world[n])) < 0.0f;
    for (const Primitive& p : model.meshes[static_cast<std::size_t>(model.nodes[n].mesh)].primitives) {
      for (std::uint32_t i = 0; i < p.index_count; i += 3) {
        Triangle t{p.material, {}};
        for (std::uint32_t k = 0; k < 3; ++k) {
          Vertex v = model.vertices[model.indices[p.first_index + i + k]];
          t.second[mirrored ? 2 - k : k] = world_corner(v, world[n]);
        }
        std::rotate(t.second.begin(), std::min_element(t.second.begin(), t.second.end()), t.second.end());
        triangles.push_back(t);
      }
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Components are multiples of 1/8 from -1 to 1.
vec3 random_vector(std::mt19937& random) {
  const auto number = [&] { return (static_cast<float>(random() % 17) - 8.0f) / 8.0f; };
  const float x = number(), y = number();
  return {x, y, number()};
}

vec3 random_axis(std::mt19937& random) {
  vec3 axis(0.0f);
  axis[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1.0f : -1.0f;
  return axis;
}

Vertex random_vertex(std::mt19937& random) {
  Vertex v;
  v.position = random_vector(random);
  v.normal = random_axis(random);
  v.tangent = vec4(v.normal.z, v.normal.x, v.normal.y, random() % 2 == 0 ? 1.0f : -1.0f);
  v.uv0 = random_vector(random);
  v.uv1 = random_vector(random);
  v.colour = static_cast<std::uint32_t>(random());
  return v;
}

void add_random_mesh(Model& model, std::mt19937& random) {
  Mesh mesh{"mesh", {}, static_cast<std::uint32_t>(model.vertices.size()), 12};
  for (int i = 0; i < 12; ++i) model.vertices.push_back(random_vertex(random));
  for (unsigned i = 0; i < 1 + random() % 3; ++i) {
    Primitive p{static_cast<std::uint32_t>(model.indices.size()), 9,
                static_cast<int>(random() % (model.materials.size() + 1)) - 1};
    p.low = vec3(1e9f);
    p.high = -p.low;
    for (int k = 0; k < 9; ++k) {
      model.indices.push_back(mesh.first_vertex + static_cast<std::uint32_t>(random() % 12));
      p.low = glm::min(p.low, model.vertices[model.indices.back()].position);
      p.high = glm::max(p.high, model.vertices[model.indices.back()].position);
    }
    mesh.primitives.push_back(p);
  }
  model.meshes.push_back(mesh);
}

// Meshes on a tree of nodes with mirroring and non-uniform scales; some meshes are used by several nodes.
Model random_model(unsigned seed) {
  std::mt19937 random(seed);
  Model model;
  model.materials.resize(5);
  model.textures.resize(2);
  for (Texture& t : model.textures) t.pixels = Image{1, 1, {1, 2, 3, 4}};
  for (std::size_t i = 0; i < 5; ++i) model.materials[i].normal_map.texture = static_cast<int>(i % 3) - 1;
  for (int i = 0; i < 8; ++i) add_random_mesh(model, random);
  for (int i = 0; i < 30; ++i) {
    Node node;
    node.name = "node" + std::to_string(i);
    node.parent = i < 3 ? kNone : static_cast<int>(random() % static_cast<unsigned>(i));
    node.translation = random_vector(random);
    node.rotation = glm::angleAxis(std::acos(0.0f), random_axis(random));
    constexpr float scales[] = {1.0f, 0.5f, 2.0f, -1.0f};
    for (int k = 0; k < 3; ++k) node.scale[k] = scales[random() % 4];
    node.mesh = static_cast<int>(random() % 9) - 1;
    model.nodes.push_back(node);
  }
  model.skipped = {"cameras"};
  return model;
}

bool is_below(const Model& model, std::size_t node, const std::set<std::string_view>& names) {
  for (int n = static_cast<int>(node); n != kNone; n = model.nodes[static_cast<std::size_t>(n)].parent) {
    if (names.count(model.nodes[static_cast<std::size_t>(n)].name) != 0) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("merging static meshes keeps every world-space triangle, with fewer draws") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Model model = random_model(seed);
    const std::vector<std::string_view> moving{"node5", "node7", "node20"};
    const Model merged = merge_static(model, moving);
    REQUIRE(is_valid(model));
    REQUIRE(is_valid(merged));
    CHECK(merged.triangle_count() == model.triangle_count());
    CHECK(sorted_triangles(merged) == sorted_triangles(model));
    int moving_draws = 0;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const bool moves = is_below(model, i, {moving.begin(), moving.end()});
      CHECK(merged.nodes[i].name == model.nodes[i].name);
      CHECK(merged.nodes[i].local() == model.nodes[i].local());
      CHECK((merged.nodes[i].mesh == kNone) == (model.nodes[i].mesh == kNone || !moves));
      if (merged.nodes[i].mesh == kNone) continue;
      moving_draws += static_cast<int>(merged.meshes[static_cast<std::size_t>(merged.nodes[i].mesh)].primitives.size());
    }
    const Node& root = merged.nodes.back();
    CHECK(root.name == "Static");
    CHECK(root.parent == kNone);
    CHECK(draw_count(merged) ==
          moving_draws + static_cast<int>(merged.meshes[static_cast<std::size_t>(root.mesh)].primitives.size()));
    CHECK(draw_count(merged) <=
          moving_draws + static_cast<int>(model.materials.size()) + 1);  // + 1 for the default material
    CHECK(draw_count(merged) < draw_count(model));
  }
}

TEST_CASE("the comparison detects a moved corner, a reversed triangle and a mirrored texture") {
  const Model model = random_model(1);
  const auto changed = [&](auto change) {
    Model other = model;
    change(other);
    return sorted_triangles(other) != sorted_triangles(model);
  };
  const std::uint32_t first = model.meshes[static_cast<std::size_t>(model.nodes[4].mesh)].primitives[0].first_index;
  CHECK(changed([&](Model& m) { m.vertices[m.indices[first]].position.x += 0.01f; }));
  CHECK(changed([&](Model& m) { std::swap(m.indices[first], m.indices[first + 1]); }));
  CHECK(changed([&](Model& m) { m.vertices[m.indices[first]].tangent *= vec4(1, 1, 1, -1); }));
  CHECK_FALSE(changed([](Model&) {}));
}

TEST_CASE("a merged normal stays perpendicular to its triangle, for any scale, shear and mirroring") {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> number(-1.0f, 1.0f);
  const auto vector = [&] { return vec3(number(random), number(random), number(random)); };
  Model model;
  for (int i = 0; i < 60; ++i) {
    Mesh mesh{"triangle", {{static_cast<std::uint32_t>(3 * i), 3}}, static_cast<std::uint32_t>(3 * i), 3};
    const vec3 corners[] = {vector(), vector(), vector()};
    for (const vec3& corner : corners) {
      Vertex v;
      v.position = corner;
      v.normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
      v.tangent = vec4(glm::normalize(corners[1] - corners[0]), 1.0f);
      model.indices.push_back(static_cast<std::uint32_t>(model.vertices.size()));
      model.vertices.push_back(v);
    }
    model.meshes.push_back(mesh);
    Node node;
    node.parent = i % 3 == 0 ? kNone : i - 1;  // chains of three nodes: scale, rotation and another scale make shear
    node.rotation = glm::normalize(glm::quat(number(random), vector()));
    node.scale = vec3(1.2f) + vector();
    if (i % 2 == 0) node.scale.x = -node.scale.x;
    node.mesh = i;
    model.nodes.push_back(node);
  }
  const Model merged = merge_static(model, {});
  REQUIRE(merged.indices.size() == 180);
  for (std::size_t i = 0; i < 180; i += 3) {
    const Vertex* v[3];
    for (std::size_t k = 0; k < 3; ++k) v[k] = &merged.vertices[merged.indices[i + k]];
    const vec3 normal = glm::normalize(glm::cross(v[1]->position - v[0]->position, v[2]->position - v[0]->position));
    for (const Vertex* corner : v) {
      CHECK(glm::dot(corner->normal, normal) > 0.999f);
      CHECK(std::abs(glm::dot(vec3(corner->tangent), normal)) < 1e-3f);
    }
  }
}

TEST_CASE("a skinned mesh is never merged, and keeps its joints") {
  Model model = random_model(9);
  model.nodes[4].mesh = 2;
  model.nodes[4].skin = 0;
  model.skins.push_back({{1, 2}, {glm::mat4(1), glm::mat4(1)}});
  model.vertex_joints.resize(model.vertices.size());
  for (std::uint32_t i = 0; i < 12; ++i) model.vertex_joints[model.meshes[2].first_vertex + i].joint[0] = 1;
  const Model merged = merge_static(model, {});
  REQUIRE(is_valid(merged));
  REQUIRE(merged.nodes[4].mesh != kNone);
  const Mesh& mesh = merged.meshes[static_cast<std::size_t>(merged.nodes[4].mesh)];
  for (std::uint32_t i = 0; i < 12; ++i) CHECK(merged.vertex_joints[mesh.first_vertex + i].joint[0] == 1);
  CHECK(sorted_triangles(merged) == sorted_triangles(model));
}

TEST_CASE("unknown names of moving nodes are rejected, and names must match completely") {
  const Model model = random_model(2);
  const std::string_view unknown[] = {"node"};
  CHECK_THROWS_WITH_AS(merge_static(model, unknown), doctest::Contains("'node'"), std::invalid_argument);
  const std::string_view moving[] = {"node2"};
  const Model merged = merge_static(model, moving);
  for (std::size_t i = 20; i < 30; ++i) {  // "node20" ... have the same prefix, but must not count as moving
    if (!is_below(model, i, {"node2"})) CHECK(merged.nodes[i].mesh == kNone);
  }
}

TEST_CASE("an appended model is drawn as before, with its own materials, textures and joints") {
  Model base = random_model(3), part = random_model(4);
  part.skins.push_back({{3, 4}, {glm::mat4(1), glm::mat4(1)}});
  part.nodes[6].mesh = 1;
  part.nodes[6].skin = 0;
  part.vertex_joints.resize(part.vertices.size());
  part.skipped = {"cameras", "lines"};
  for (Material& m : part.materials) m.name = "part";
  Model both = base;
  const int first = append_model(both, part);
  REQUIRE(is_valid(both));
  CHECK(first == static_cast<int>(base.nodes.size()));
  CHECK(both.nodes.size() == base.nodes.size() + part.nodes.size());
  CHECK(both.nodes[static_cast<std::size_t>(first)].parent == kNone);
  CHECK(both.nodes[static_cast<std::size_t>(first) + 6].skin == 0);
  CHECK(both.skins[0].joints == std::vector<int>{first + 3, first + 4});
  CHECK(both.skipped == std::vector<std::string>{"cameras", "lines"});
  CHECK(both.textures.size() == 4);
  CHECK(both.materials[7].normal_map.texture == 2 + part.materials[2].normal_map.texture);
  CHECK(draw_count(both) == draw_count(base) + draw_count(part));
  // Expected: the triangles of the base, and those of the part with material indices offset by the number of materials
  // of the base.
  std::vector<Triangle> expected = sorted_triangles(base);
  for (Triangle t : sorted_triangles(part)) {
    if (t.first != kNone) t.first += static_cast<int>(base.materials.size());
    expected.push_back(t);
  }
  std::sort(expected.begin(), expected.end());
  CHECK(sorted_triangles(both) == expected);
}

TEST_CASE("a model appended to a node moves with it") {
  Model base = random_model(5);
  const Model part = random_model(6);
  const std::vector<glm::mat4> part_pose = rest_pose(part);
  const int first = append_model(base, part, 11);
  const std::vector<glm::mat4> world = rest_pose(base);
  for (std::size_t i = 0; i < part_pose.size(); ++i) {
    const glm::mat4 expected = world[11] * part_pose[i], world_corner = world[static_cast<std::size_t>(first) + i];
    for (int c = 0; c < 4; ++c) CHECK(glm::distance(world_corner[c], expected[c]) < 1e-4f);
  }
  CHECK_THROWS_AS(append_model(base, part, 1000), std::invalid_argument);
}

TEST_CASE("every shipped model is valid, fully drawn, and unchanged by merging") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(GEARSHIFT_ASSETS) / "models")) {
    if (entry.path().extension() != ".glb") continue;
    CAPTURE(entry.path().string());
    const Model model = read_gltf(entry.path());
    CHECK(is_valid(model));
    CHECK(model.skipped.empty());
    const Model merged = merge_static(model, {});
    CHECK(is_valid(merged));
    CHECK(merged.triangle_count() == model.triangle_count());
    CHECK(draw_count(merged) <= static_cast<int>(model.materials.size() + 1 + model.skins.size()));
    ++count;
  }
  CHECK(count > 0);
}
