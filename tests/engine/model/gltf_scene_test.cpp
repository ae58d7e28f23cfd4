// Nodes, materials, textures and skins of a glTF file.
#include <cmath>
#include <map>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/engine/model/gltf_maker.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using doctest::Approx;
using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

namespace {

const std::filesystem::path data_folder = std::filesystem::path(GEARSHIFT_TEST_DATA) / "gltf";

double worst_entry(const mat4& a, const mat4& b) {
  double worst = 0.0;
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) worst = std::max(worst, std::abs(static_cast<double>(a[c][r] - b[c][r])));
  }
  return worst;
}

json columns(const mat4& m) {
  json list = json::array();
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) list.push_back(m[c][r]);
  }
  return list;
}

Image dot(std::uint8_t red) {
  return {2, 1, {red, 2, 3, 255, 4, 5, 6, 7}};
}

std::vector<std::uint8_t> png_bytes(const Image& image) {
  TempFolder folder;
  write_png(folder / "image.png", image);
  return read_bytes(folder / "image.png");
}

// The test triangle, with one material.
GltfMaker with_material(json material) {
  GltfMaker maker = triangle();
  maker.append("materials", std::move(material));
  maker.root["meshes"][0]["primitives"][0]["material"] = 0;
  return maker;
}

}  // namespace

TEST_CASE("children listed before their parents come after them in the model, at the place that the file gives them") {
  GltfMaker maker = triangle();  // node 0: "node"
  const float half = std::sqrt(0.5f);
  maker.append("nodes", {{"name", "hand"}, {"translation", {0, 1, 0}}, {"children", {0}}});
  maker.append("nodes", {{"name", "arm"}, {"rotation", {0, 0, half, half}}, {"scale", {2, 2, 2}}, {"children", {1}}});
  const Model model = read_back(maker);
  REQUIRE(model.nodes.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(model.nodes[i].parent < static_cast<int>(i));
  CHECK(model.nodes[static_cast<std::size_t>(model.node("node"))].mesh == 0);
  CHECK(model.nodes[static_cast<std::size_t>(model.node("hand"))].parent == model.node("arm"));
  // The node's origin, moved by 1 along y, rotated by 90 degrees about z and scaled by 2, is at (-2, 0, 0).
  const vec4 position = rest_pose(model)[static_cast<std::size_t>(model.node("node"))][3];
  CHECK(glm::distance(position, vec4(-2, 0, 0, 1)) < 1e-6f);
  CHECK(model.node("nobody") == kNone);
}

TEST_CASE("a matrix gives the same node as its translation, rotation and scale, mirrored or not") {
  for (const vec3 scale : {vec3(1, 2, 3), vec3(-1, 2, 3), vec3(1, 2, -0.5f)}) {
    mat4 expected = glm::translate(mat4(1), vec3(4, 5, 6));
    expected = glm::rotate(expected, 0.7f, glm::normalize(vec3(1, 2, 3)));
    expected = glm::scale(expected, scale);
    GltfMaker maker = triangle();
    maker.root["nodes"][0]["matrix"] = columns(expected);
    const Model model = read_back(maker);
    CHECK(worst_entry(model.nodes[0].local(), expected) < 1e-5);
    CHECK(worst_entry(rest_pose(model)[0], expected) < 1e-5);
  }
}

TEST_CASE("a matrix with shear or perspective is rejected") {
  mat4 shear(1), perspective(1);
  shear[1][0] = 0.5f;
  perspective[2][3] = 1.0f;
  for (const mat4& matrix : {shear, perspective}) {
    GltfMaker maker = triangle();
    maker.root["nodes"][0]["matrix"] = columns(matrix);
    CHECK_THROWS_AS(read_back(maker), GltfError);
  }
}

TEST_CASE("only the default scene is read, and skipped scenes are reported") {
  GltfMaker maker = triangle();
  maker.append("nodes", {{"name", "attic"}, {"mesh", 0}});
  maker.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  CHECK(read_back(maker).nodes.at(0).name == "node");  // the first scene, because no scene is the default
  maker.root["scene"] = 1;
  const Model model = read_back(maker);
  REQUIRE(model.nodes.size() == 1);
  CHECK(model.nodes[0].name == "attic");
  CHECK(model.skipped == std::vector<std::string>{"scenes other than the default one"});
}

TEST_CASE("a file that requires version 2.0 of glTF is read") {
  GltfMaker maker = triangle();
  maker.root["asset"]["minVersion"] = "2.0";
  CHECK(read_back(maker).nodes.size() == 1);
}

TEST_CASE("a mesh scaled out of range is not drawn, and not reported as scaled to zero") {
  GltfMaker maker = triangle();
  maker.root["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
  const Model huge = read_back(maker);
  CHECK(huge.nodes[0].mesh == kNone);
  REQUIRE(huge.skipped.size() == 1);
  CHECK(huge.skipped[0].find("zero") == std::string::npos);
  CHECK(huge.skipped[0].find("out of range") != std::string::npos);
}

TEST_CASE("a mesh scaled to zero is not drawn, and reported; a mirrored one is drawn") {
  GltfMaker maker = triangle();
  maker.root["nodes"][0]["scale"] = {1, 0, 1};
  const Model flat = read_back(maker);
  CHECK(flat.nodes[0].mesh == kNone);
  CHECK(flat.skipped.size() == 1);
  maker.root["nodes"][0]["scale"] = {1, -1, 1};
  CHECK(read_back(maker).nodes[0].mesh == 0);
}

TEST_CASE("a material has every number that the file gives, and glTF's defaults for the rest") {
  const Model plain = read_back(with_material(json::object()));
  const Material& defaults = plain.materials.at(0);
  CHECK(defaults.base_colour == vec4(1));
  CHECK(defaults.metallic == 1.0f);
  CHECK(defaults.roughness == 1.0f);
  CHECK(defaults.emissive == vec3(0));
  CHECK(defaults.alpha_mode == AlphaMode::opaque);
  CHECK(defaults.alpha_cutoff == 0.5f);
  CHECK_FALSE(defaults.double_sided);
  CHECK(defaults.base_colour_map.texture == kNone);

  const Model model = read_back(
      with_material({{"name", "Glass"},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.6}}},
                     {"emissiveFactor", {0.25, 0.5, 2.0}},
                     {"alphaMode", "MASK"},
                     {"alphaCutoff", 0.75},
                     {"doubleSided", true},
                     {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}}));
  const Material& m = model.materials.at(0);
  CHECK(m.name == "Glass");
  CHECK(glm::distance(m.base_colour, vec4(0.1f, 0.2f, 0.3f, 0.4f)) < 1e-6f);
  CHECK(m.metallic == 0.5f);
  CHECK(m.roughness == 0.6f);
  CHECK(m.emissive == vec3(2, 4, 8));  // the emissive factor, clamped to 1, times the emissive strength
  CHECK(m.alpha_mode == AlphaMode::mask);
  CHECK(m.alpha_cutoff == 0.75f);
  CHECK(m.double_sided);
  CHECK(model.meshes[0].primitives[0].material == 0);
  CHECK(read_back(with_material({{"alphaMode", "BLEND"}})).materials[0].alpha_mode == AlphaMode::blend);
}

TEST_CASE("every map of a material has its picture, its UV set and its colour space") {
  GltfMaker maker = with_material(
      {{"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}, {"texCoord", 1}}}}},
       {"normalTexture", {{"index", 2}, {"scale", 0.5}}},
       {"occlusionTexture", {{"index", 1}, {"strength", 0.25}, {"texCoord", 1}}},
       {"emissiveTexture", {{"index", 2}}}});
  for (const int red : {10, 20, 30}) {
    maker.append("images", {{"uri", data_uri(png_bytes(dot(static_cast<std::uint8_t>(red))), "image/png")}});
  }
  maker.append("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
  for (const int image : {0, 1, 2}) maker.append("textures", {{"source", image}});
  maker.root["textures"][0]["sampler"] = 0;
  const Model model = read_back(maker);
  const Material& m = model.materials[0];
  const auto texture = [&](const TextureUse& use) { return model.textures.at(static_cast<std::size_t>(use.texture)); };
  CHECK(texture(m.base_colour_map).pixels.rgba[0] == 10);
  CHECK(texture(m.base_colour_map).srgb);
  CHECK(texture(m.base_colour_map).wrap_u == Wrap::clamp);
  CHECK(texture(m.base_colour_map).wrap_v == Wrap::mirror);
  CHECK_FALSE(texture(m.base_colour_map).linear);
  CHECK(texture(m.metal_rough_map).pixels.rgba == dot(20).rgba);
  CHECK_FALSE(texture(m.metal_rough_map).srgb);
  CHECK(texture(m.metal_rough_map).wrap_u == Wrap::repeat);
  CHECK(texture(m.metal_rough_map).linear);
  CHECK(m.metal_rough_map.uv_set == 1);
  CHECK(m.occlusion_map.texture == m.metal_rough_map.texture);  // an image that is used twice becomes one texture
  CHECK(m.occlusion_strength == 0.25f);
  CHECK(m.normal_scale == 0.5f);
  // An image used as data and as colour becomes two textures.
  CHECK(texture(m.normal_map).pixels.rgba == texture(m.emissive_map).pixels.rgba);
  CHECK_FALSE(texture(m.normal_map).srgb);
  CHECK(texture(m.emissive_map).srgb);
  CHECK(model.textures.size() == 4);
}

TEST_CASE("a texture transform is translation * rotation * scale and takes the example's quarter of the picture") {
  GltfMaker maker = with_material({{"emissiveTexture", {{"index", 0}, {"texCoord", 0}}}});
  maker.append("images", {{"uri", data_uri(png_bytes(dot(1)), "image/png")}});
  maker.append("textures", {{"source", 0}});
  // The first example in KHR_texture_transform: the lower left quadrant, rotated by 90 degrees.
  maker.root["materials"][0]["emissiveTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}, {"texCoord", 1}};
  const TextureUse use = read_back(maker).materials[0].emissive_map;
  CHECK(use.uv_set == 1);
  CHECK_FALSE(use.plain());
  const auto moved = [&](float u, float v) { return vec2(use.matrix() * vec3(u, v, 1)); };
  for (const vec2 uv : {moved(0, 0), moved(1, 0), moved(0, 1), moved(1, 1), moved(0.3f, 0.6f)}) {
    CHECK(uv.x >= -1e-6f);  // left half: u from 0 to 0.5
    CHECK(uv.x <= 0.5f + 1e-6f);
    CHECK(uv.y >= 0.5f - 1e-6f);  // lower half: v from 0.5 to 1, because v points down
    CHECK(uv.y <= 1.0f + 1e-6f);
  }
  // The second example in KHR_texture_transform: the texture is flipped vertically.
  maker.root["materials"][0]["emissiveTexture"]["extensions"]["KHR_texture_transform"] = {{"offset", {0, 1}},
                                                                                          {"scale", {1, -1}}};
  const TextureUse inverted = read_back(maker).materials[0].emissive_map;
  CHECK(vec2(inverted.matrix() * vec3(0.25f, 0.25f, 1)) == vec2(0.25f, 0.75f));
  // Scale is applied first, then rotation, then offset.
  const TextureUse all{0, 0, {0.1f, 0.2f}, {2.0f, 3.0f}, 0.4f};
  const double c = std::cos(0.4), s = std::sin(0.4), u = 2.0 * 0.5, v = 3.0 * 0.25;
  const vec2 uv = vec2(all.matrix() * vec3(0.5f, 0.25f, 1));
  CHECK(uv.x == Approx(0.1 + c * u + s * v));
  CHECK(uv.y == Approx(0.2 - s * u + c * v));
  CHECK(TextureUse{}.matrix() == glm::mat3(1));
}

TEST_CASE("a picture may be in a data URI, in a buffer, or in a file next to the model; as PNG or JPEG") {
  TempFolder folder;
  write_png(folder / "my dot.png", dot(77));
  GltfMaker maker = with_material({{"emissiveTexture", {{"index", 0}}}});
  maker.append("textures", {{"source", 0}});
  const std::vector<std::uint8_t> png = png_bytes(dot(77));
  const json sources[] = {{{"uri", data_uri(png, "image/png")}},
                          {{"bufferView", maker.view(png)}, {"mimeType", "image/png"}},
                          {{"uri", "my%20dot.png"}},
                          {{"uri", "./my dot.png"}}};
  for (const json& source : sources) {
    CAPTURE(source.dump());
    maker.root["images"] = json::array({source});
    const Model model = read_back(maker.gltf(), folder);
    REQUIRE(model.textures.size() == 1);
    CHECK(model.textures[0].pixels.rgba == dot(77).rgba);
  }
  maker.root["images"] = {
      {{"bufferView", maker.view(read_bytes(data_folder / "red_8x8.jpg"))}, {"mimeType", "image/jpeg"}}};
  const Image jpeg = read_back(maker).textures.at(0).pixels;
  CHECK(jpeg.width == 8);
  CHECK(jpeg.height == 8);
  const int expected[4] = {200, 40, 20, 255};
  for (std::size_t i = 0; i < jpeg.rgba.size(); ++i) CHECK(std::abs(jpeg.rgba[i] - expected[i % 4]) <= 3);
}

TEST_CASE("buffers may be in files in or below the model's folder, and longer than needed") {
  TempFolder folder;
  GltfMaker maker = triangle();
  std::filesystem::create_directory(folder / "data");
  write_bytes(folder / "data/a+b.bin", std::string(maker.bytes.begin(), maker.bytes.end()) + "rest");
  json text = maker.root;
  text["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", "data/a+b.bin"}}};
  CHECK(read_back(text.dump(), folder).vertices.size() == 3);
}

TEST_CASE("no path leads out of the file's folder") {
  TempFolder outside, folder;
  GltfMaker maker = triangle();
  write_bytes(outside / "secret.bin", std::string(maker.bytes.begin(), maker.bytes.end()));
  std::filesystem::create_symlink(outside / "secret.bin", folder / "link.bin");
  std::filesystem::create_directory_symlink(outside.path(), folder / "door");
  json text = maker.root;
  const std::string name = outside.path().filename().string();
  for (const std::string& uri :
       {"../" + name + "/secret.bin", "x/../../" + name + "/secret.bin", (outside / "secret.bin").string(),
        "file://" + (outside / "secret.bin").string(), "%2e%2e/" + name + "/secret.bin", std::string("link.bin"),
        std::string("door/secret.bin"), std::string("http://localhost/secret.bin"), std::string(""), std::string("."),
        std::string("a%00b"), std::string("none.bin")}) {
    CAPTURE(uri);
    text["buffers"] = {{{"byteLength", maker.bytes.size()}, {"uri", uri}}};
    CHECK_THROWS_AS(read_back(text.dump(), folder), GltfError);
  }
}

TEST_CASE("a skin keeps its joints, bind matrices and weights, and the weights are scaled to a sum of 1") {
  GltfMaker maker;
  const mat4 bind = glm::translate(mat4(1), vec3(0, -1, 0));
  std::vector<float> matrices;
  for (const mat4& m : {mat4(1), bind}) matrices.insert(matrices.end(), &m[0][0], &m[0][0] + 16);
  maker.add_primitive(
      {{"POSITION", maker.accessor(triangle_corners, "VEC3", f32)},
       {"JOINTS_0", maker.accessor(std::vector<std::uint8_t>{0, 1, 9, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", u8)},
       {"WEIGHTS_0", maker.accessor(std::vector<float>{1, 3, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", f32)}});
  maker.add_primitive({{"POSITION", 0}});
  maker.append("nodes", {{"name", "root"}, {"children", {3}}});
  maker.append("nodes", {{"name", "tip"}, {"translation", {0, 1, 0}}});
  maker.append("skins", {{"joints", {2, 3}}, {"inverseBindMatrices", maker.accessor(matrices, "MAT4", f32)}});
  maker.root["nodes"][0]["skin"] = 0;
  const Model model = read_back(maker);
  REQUIRE(model.skins.size() == 1);
  CHECK(model.skins[0].joints == std::vector<int>{model.node("root"), model.node("tip")});
  CHECK(model.skins[0].inverse_bind[1] == bind);
  CHECK(model.nodes[0].skin == 0);
  REQUIRE(model.vertex_joints.size() == model.vertices.size());
  CHECK(model.vertex_joints[0].weight[0] == 0.25f);
  CHECK(model.vertex_joints[0].weight[1] == 0.75f);
  CHECK(model.vertex_joints[0].joint[2] == 0);  // the file has joint 9 here, but its weight is 0
  CHECK(model.vertex_joints[1].joint[0] == 1);
  CHECK(model.vertex_joints[2].weight[0] == 1.0f);  // this vertex has no weights in the file

  maker.root["skins"][0].erase("inverseBindMatrices");
  CHECK(read_back(maker).skins[0].inverse_bind[1] == mat4(1));
}

TEST_CASE("a skin that the scene does not use is not read, whatever it refers to") {
  GltfMaker maker = triangle();
  maker.append("nodes", {{"name", "elsewhere"}});
  maker.append("skins", {{"joints", {1}}});
  maker.append("scenes", {{"nodes", {0}}});
  maker.append("scenes", {{"nodes", {1}}});
  maker.root["scene"] = 0;
  CHECK(read_back(maker).triangle_count() == 1);
}

TEST_CASE("an unknown required extension rejects the file and is named") {
  GltfMaker maker = triangle();
  maker.root["extensionsUsed"] =
      maker.root["extensionsRequired"] = {"KHR_texture_transform", "KHR_materials_emissive_strength"};
  CHECK(read_back(maker).triangle_count() == 1);
  maker.root["extensionsRequired"].push_back("KHR_draco_mesh_compression");
  CHECK_THROWS_WITH_AS(read_back(maker), doctest::Contains("KHR_draco_mesh_compression"), GltfError);
}
