// Reads vertices and triangles in every layout that glTF allows.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/model/gltf_maker.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using doctest::Approx;
using glm::vec2;
using glm::vec3;
using glm::vec4;

namespace {

// A unit square in z = 0 facing +Z: two triangles, UVs with v pointing down as in images.
const std::vector<float> square_corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<float> square_uv{0, 1, 1, 1, 1, 0, 0, 0};
const std::vector<float> square_normals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
const std::vector<std::uint16_t> square_indices{0, 1, 2, 0, 2, 3};

bool lists_as_skipped(const Model& model, const std::string& what) {
  return std::find(model.skipped.begin(), model.skipped.end(), what) != model.skipped.end();
}

vec3 corner(const Model& model, std::size_t i) {
  return model.vertices[model.indices[i]].position;
}

// Adds a material with a normal map, whose content does not matter.
int add_normal_mapped_material(GltfMaker& maker) {
  Image dot{1, 1, {128, 128, 255, 255}};
  TempFolder folder;
  write_png(folder / "dot.png", dot);
  maker.append("images", {{"uri", data_uri(read_bytes(folder / "dot.png"), "image/png")}});
  maker.append("textures", {{"source", 0}});
  return maker.append("materials", {{"normalTexture", {{"index", 0}}}});
}

}  // namespace

TEST_CASE("a triangle without normals is flat, faces the side of its winding, and has the box of its corners") {
  const Model model = read_back(triangle());
  REQUIRE(model.vertices.size() == 3);
  REQUIRE(model.indices == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(model.vertices[1].position == vec3(1, 0, 0));
  for (const Vertex& v : model.vertices) CHECK(v.normal == vec3(0, 0, 1));
  CHECK(model.vertices[0].colour == 0xffffffffu);
  REQUIRE(model.meshes.size() == 1);
  CHECK(model.meshes[0].name == "mesh");
  CHECK(model.meshes[0].vertex_count == 3);
  const Primitive& primitive = model.meshes[0].primitives.at(0);
  CHECK(primitive.index_count == 3);
  CHECK(primitive.material == kNone);
  CHECK(primitive.low == vec3(0, 0, 0));
  CHECK(primitive.high == vec3(1, 1, 0));
  CHECK(model.vertex_joints.empty());
  CHECK(model.skipped.empty());
  CHECK(model.triangle_count() == 1);
}

TEST_CASE("a model is the same read from text and from .glb") {
  GltfMaker maker = triangle();
  maker.append("nodes", {{"name", "other"}, {"mesh", 0}, {"translation", {1, 2, 3}}});
  const Model text = read_back(maker.gltf()), binary = read_back(maker.glb());
  REQUIRE(text.vertices.size() == binary.vertices.size());
  for (std::size_t i = 0; i < text.vertices.size(); ++i) {
    CHECK(text.vertices[i].position == binary.vertices[i].position);
    CHECK(text.vertices[i].normal == binary.vertices[i].normal);
  }
  CHECK(text.indices == binary.indices);
  CHECK(binary.nodes.size() == 2);
  CHECK(binary.nodes[1].translation == vec3(1, 2, 3));
}

TEST_CASE("indices of one, two and four bytes, and none, give the same triangles") {
  const auto square = [](auto sample, int type) {
    GltfMaker maker;
    const std::vector<decltype(sample)> indices{0, 1, 2, 0, 2, 3};
    maker.add_primitive({{"POSITION", maker.accessor(square_corners, "VEC3", f32)}},
                        {{"indices", maker.accessor(indices, "SCALAR", type)}});
    return read_back(maker);
  };
  GltfMaker loose;
  loose.add_primitive(
      {{"POSITION",
        loose.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", f32)}});
  const Model expected = read_back(loose);
  for (const Model& model : {square(std::uint8_t{}, u8), square(std::uint16_t{}, u16), square(std::uint32_t{}, u32)}) {
    REQUIRE(model.indices.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) CHECK(corner(model, i) == corner(expected, i));
  }
}

TEST_CASE("a strip and a fan become the triangles of the specification, all facing one way") {
  // By glTF 2.0 section 3.7.2.1, the strip 0 1 2 3 becomes the triangles 0 1 2 and 1 3 2, and the fan 0 1 2 3 becomes
  // the triangles 1 2 0 and 2 3 0.
  const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  GltfMaker maker;
  maker.add_primitive({{"POSITION", maker.accessor(strip, "VEC3", f32)}}, {{"mode", 5}});
  maker.add_primitive({{"POSITION", maker.accessor(square_corners, "VEC3", f32)}}, {{"mode", 6}});
  const Model model = read_back(maker);
  REQUIRE(model.indices.size() == 12);
  const vec3 expected[12] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                             {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  for (std::size_t i = 0; i < 12; ++i) CHECK(corner(model, i) == expected[i]);
  for (const Vertex& v : model.vertices) CHECK(v.normal == vec3(0, 0, 1));
}

TEST_CASE("points and lines are not drawn, and are reported once") {
  GltfMaker maker = triangle();
  for (const int mode : {0, 1, 2, 3, 0}) maker.add_primitive({{"POSITION", 0}}, {{"mode", mode}});
  const Model model = read_back(maker);
  CHECK(model.triangle_count() == 1);
  CHECK(model.skipped == std::vector<std::string>{"lines", "points"});
}

TEST_CASE("interleaved attributes are read with their stride, from any offset") {
  GltfMaker maker;
  std::vector<float> mixed{99.0f, 99.0f};  // 8 unused bytes before the first element
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 3; ++k) mixed.push_back(square_corners[3 * i + k]);
    for (std::size_t k = 0; k < 2; ++k) mixed.push_back(square_uv[2 * i + k]);
  }
  const int view = maker.view(mixed);
  maker.root["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 20;
  const int position = maker.append(
      "accessors", {{"bufferView", view}, {"byteOffset", 8}, {"componentType", f32}, {"count", 4}, {"type", "VEC3"}});
  const int uv = maker.append(
      "accessors", {{"bufferView", view}, {"byteOffset", 20}, {"componentType", f32}, {"count", 4}, {"type", "VEC2"}});
  maker.add_primitive(
      {{"POSITION", position}, {"TEXCOORD_0", uv}, {"NORMAL", maker.accessor(square_normals, "VEC3", f32)}},
      {{"indices", maker.accessor(square_indices, "SCALAR", u16)}});
  const Model model = read_back(maker);
  REQUIRE(model.vertices.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(model.vertices[i].position ==
          vec3(square_corners[3 * i], square_corners[3 * i + 1], square_corners[3 * i + 2]));
    CHECK(model.vertices[i].uv0 == vec2(square_uv[2 * i], square_uv[2 * i + 1]));
  }
}

TEST_CASE("normalised UV coordinates are fractions, in both sets") {
  GltfMaker maker;
  maker.add_primitive(
      {{"POSITION", maker.accessor(triangle_corners, "VEC3", f32)},
       {"TEXCOORD_0", maker.accessor(std::vector<std::uint8_t>{0, 255, 51, 102, 0, 0}, "VEC2", u8, true)},
       {"TEXCOORD_1", maker.accessor(std::vector<std::uint16_t>{0, 65535, 13107, 26214, 0, 0}, "VEC2", u16, true)}});
  const Model model = read_back(maker);
  for (const vec2 uv : {model.vertices[0].uv0, model.vertices[0].uv1}) CHECK(uv == vec2(0.0f, 1.0f));
  for (const vec2 uv : {model.vertices[1].uv0, model.vertices[1].uv1}) {
    CHECK(uv.x == Approx(0.2));
    CHECK(uv.y == Approx(0.4));
  }
}

TEST_CASE("vertex colours in every format give the same colour") {
  // Reads a triangle whose colour is (1, 0.2, 0.4), with alpha 0.6 or without alpha.
  const auto read = [](auto values, const char* type, int component) {
    GltfMaker maker;
    const bool normalized = component != f32;
    const auto once = values;
    for (int i = 0; i < 2; ++i) values.insert(values.end(), once.begin(), once.end());
    maker.add_primitive({{"POSITION", maker.accessor(triangle_corners, "VEC3", f32)},
                         {"COLOR_0", maker.accessor(values, type, component, normalized)}});
    return read_back(maker).vertices[2].colour;
  };
  CHECK(read(std::vector<float>{1.0f, 0.2f, 0.4f}, "VEC3", f32) == 0xff6633ffu);
  CHECK(read(std::vector<float>{1.0f, 0.2f, 0.4f, 0.6f}, "VEC4", f32) == 0x996633ffu);
  CHECK(read(std::vector<std::uint16_t>{65535, 13107, 26214}, "VEC3", u16) == 0xff6633ffu);
  CHECK(read(std::vector<std::uint16_t>{65535, 13107, 26214, 39321}, "VEC4", u16) == 0x996633ffu);
  CHECK(read(std::vector<std::uint8_t>{255, 51, 102, 153}, "VEC4", u8) == 0x996633ffu);
  CHECK(read(std::vector<float>{7.0f, -1.0f, 0.4f}, "VEC3", f32) == 0xff6600ffu);  // clamped
}

TEST_CASE("a sparse accessor replaces the elements that it names, whether they are stored or zero") {
  GltfMaker maker;
  const int base = maker.accessor(triangle_corners, "VEC3", f32);
  const int indices = maker.view(std::vector<std::uint16_t>{0, 2});
  const int values = maker.view(std::vector<float>{5, 0, 0, 0, 6, 0});
  const json sparse = {{"count", 2},
                       {"indices", {{"bufferView", indices}, {"componentType", u16}}},
                       {"values", {{"bufferView", values}}}};
  maker.root["accessors"][static_cast<std::size_t>(base)]["sparse"] = sparse;
  const int over_zeros =
      maker.append("accessors", {{"componentType", f32}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
  maker.add_primitive({{"POSITION", base}});
  maker.add_primitive({{"POSITION", over_zeros}});
  const Model model = read_back(maker);
  CHECK(corner(model, 0) == vec3(5, 0, 0));
  CHECK(corner(model, 1) == vec3(1, 0, 0));
  CHECK(corner(model, 2) == vec3(0, 6, 0));
  CHECK(corner(model, 4) == vec3(0, 0, 0));
  CHECK(corner(model, 5) == vec3(0, 6, 0));
}

TEST_CASE("meshes share no vertices, and indices count from the first vertex of the model") {
  GltfMaker maker = triangle();
  maker.add_primitive({{"POSITION", 0}});
  maker.root["meshes"][1]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
  const Model model = read_back(maker);
  REQUIRE(model.meshes.size() == 2);
  CHECK(model.meshes[1].first_vertex == 3);
  CHECK(model.meshes[1].vertex_count == 6);
  CHECK(model.indices == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8});
}

TEST_CASE("a fold without normals gets one normal per face, none shared along the crease") {
  GltfMaker maker;  // one triangle in z = 0, one in x = 0, sharing an edge along y
  const std::vector<float> fold{0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, -1};
  maker.add_primitive({{"POSITION", maker.accessor(fold, "VEC3", f32)}},
                      {{"indices", maker.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 3, 1}, "SCALAR", u8)}});
  const Model model = read_back(maker);
  REQUIRE(model.vertices.size() == 6);
  for (std::size_t i = 0; i < 3; ++i) CHECK(model.vertices[i].normal == vec3(0, 0, 1));
  for (std::size_t i = 3; i < 6; ++i) CHECK(model.vertices[i].normal == vec3(1, 0, 0));
}

TEST_CASE("normals are normalised, and one of zero length is computed from its triangles") {
  GltfMaker maker;
  std::vector<float> normals{0, 0, 3, 0, 0, 0, 0, 2, 0, 0, 0, 1};
  maker.add_primitive(
      {{"POSITION", maker.accessor(square_corners, "VEC3", f32)}, {"NORMAL", maker.accessor(normals, "VEC3", f32)}},
      {{"indices", maker.accessor(square_indices, "SCALAR", u16)}});
  const Model model = read_back(maker);
  REQUIRE(model.vertices.size() == 4);
  CHECK(model.vertices[0].normal == vec3(0, 0, 1));
  CHECK(model.vertices[1].normal == vec3(0, 0, 1));
  CHECK(model.vertices[2].normal == vec3(0, 1, 0));
}

TEST_CASE("tangents point along u, and bitangents up the picture") {
  for (const bool mirrored : {false, true}) {
    GltfMaker maker;
    std::vector<float> uv = square_uv;
    for (std::size_t i = 0; mirrored && i < uv.size(); i += 2) uv[i] = 1.0f - uv[i];
    const int material = add_normal_mapped_material(maker);
    maker.add_primitive({{"POSITION", maker.accessor(square_corners, "VEC3", f32)},
                         {"NORMAL", maker.accessor(square_normals, "VEC3", f32)},
                         {"TEXCOORD_0", maker.accessor(uv, "VEC2", f32)}},
                        {{"indices", maker.accessor(square_indices, "SCALAR", u16)}, {"material", material}});
    const Model model = read_back(maker);
    REQUIRE(model.vertices.size() == 4);
    for (const Vertex& v : model.vertices) {
      CHECK(v.tangent.x == Approx(mirrored ? -1.0 : 1.0));
      const vec3 up = glm::cross(v.normal, vec3(v.tangent)) * v.tangent.w;
      CHECK(up.y == Approx(1.0));
    }
  }
}

TEST_CASE("tangents follow the transform of the normal map") {
  GltfMaker maker;
  const int material = add_normal_mapped_material(maker);
  // After a rotation by -90 degrees, u grows where the original v decreases, which is upwards on the square.
  maker.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"]["rotation"] = -std::acos(0.0);
  maker.add_primitive({{"POSITION", maker.accessor(square_corners, "VEC3", f32)},
                       {"NORMAL", maker.accessor(square_normals, "VEC3", f32)},
                       {"TEXCOORD_0", maker.accessor(square_uv, "VEC2", f32)}},
                      {{"indices", maker.accessor(square_indices, "SCALAR", u16)}, {"material", material}});
  const Model model = read_back(maker);
  for (const Vertex& v : model.vertices) CHECK(v.tangent.y == Approx(1.0));
}

TEST_CASE("where a mirrored triangle meets an unmirrored one, each keeps its own tangents") {
  GltfMaker maker;  // two adjacent squares with u growing from both ends to the middle
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0};
  const std::vector<float> uv{0, 1, 1, 1, 1, 0, 0, 0, 0, 1, 0, 0};
  std::vector<float> normals;
  for (int i = 0; i < 6; ++i) normals.insert(normals.end(), {0, 0, 1});
  const int material = add_normal_mapped_material(maker);
  maker.add_primitive(
      {{"POSITION", maker.accessor(positions, "VEC3", f32)},
       {"NORMAL", maker.accessor(normals, "VEC3", f32)},
       {"TEXCOORD_0", maker.accessor(uv, "VEC2", f32)}},
      {{"indices", maker.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2}, "SCALAR", u8)},
       {"material", material}});
  const Model model = read_back(maker);
  CHECK(model.vertices.size() == 8);  // the two vertices on the seam are duplicated
  CHECK(model.meshes[0].vertex_count == 8);
  for (std::size_t i = 0; i < model.indices.size(); ++i) {
    const Vertex& v = model.vertices[model.indices[i]];
    CHECK(v.tangent.x == Approx(i < 6 ? 1.0 : -1.0));
    CHECK(v.tangent.w == (i < 6 ? 1.0f : -1.0f));
  }
}

TEST_CASE("tangents in the file are kept, as unit vectors perpendicular to the normal") {
  GltfMaker maker;
  const int material = add_normal_mapped_material(maker);
  maker.add_primitive(
      {{"POSITION", maker.accessor(triangle_corners, "VEC3", f32)},
       {"NORMAL", maker.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", f32)},
       {"TANGENT", maker.accessor(std::vector<float>{0, 2, 0, -1, 0, 1, 1, 1, 0, 0, 0, 1}, "VEC4", f32)}},
      {{"material", material}});
  const Model model = read_back(maker);
  CHECK(model.vertices[0].tangent == vec4(0, 1, 0, -1));
  CHECK(model.vertices[1].tangent == vec4(0, 1, 0, 1));
  CHECK(glm::length(vec3(model.vertices[2].tangent)) == Approx(1.0));  // the tangent in the file had zero length
  CHECK(model.vertices[2].tangent.z == 0.0f);
}

TEST_CASE("each feature that is not drawn is reported once") {
  GltfMaker maker = triangle();
  json& primitive = maker.root["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
  primitive["attributes"]["TEXCOORD_2"] = maker.accessor(std::vector<float>(6), "VEC2", f32);
  primitive["attributes"]["_TEMPERATURE"] = 0;
  maker.root["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}}};
  maker.root["cameras"] = {{{"type", "perspective"}}};
  maker.root["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_texture_transform"};
  const Model model = read_back(maker);
  for (const char* what :
       {"morph targets", "attribute TEXCOORD_2", "animations", "cameras", "extension KHR_materials_clearcoat"}) {
    CAPTURE(what);
    CHECK(lists_as_skipped(model, what));
  }
  CHECK(model.skipped.size() == 5);
  CHECK(model.triangle_count() == 1);
}
