// Corrupt and malicious files must give one error sentence or a valid model, never a crash. Also run under the address
// sanitizer.
#include <functional>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "engine/model/gltf_document.h"
#include "tests/engine/model/gltf_everything.h"
#include "tests/engine/model/gltf_maker.h"
#include "tests/engine/model/model_laws.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::engine;
using namespace gearshift::test;

namespace {

const int kByteFlips = is_full_campaign() ? 4000 : 1000;  // tests/fuzz covers more
const int kValueSwaps = kByteFlips;

// Returns whether the file is rejected. A rejection must be one sentence that names the file; a model that was read
// must be valid.
bool is_rejected(const std::string& content) {
  static const TempFolder folder;
  write_bytes(folder / "model.gltf", content);
  try {
    const Model model = read_gltf(folder / "model.gltf");
    REQUIRE(is_valid(model));
    return false;
  } catch (const GltfError& e) {
    const std::string sentence = e.what();
    CAPTURE(sentence);
    CHECK(sentence.starts_with((folder / "model.gltf").string() + ": "));
    CHECK(sentence.size() < folder.path().string().size() + 300);
    CHECK(std::all_of(sentence.begin(), sentence.end(), [](char c) { return c >= 0x20 && c < 0x7f; }));
    return true;
  }
}

struct Hostile {
  std::string name;
  std::function<void(GltfMaker&)> corrupt;
};

// Sets the value to which a JSON pointer refers.
Hostile set(const char* pointer, const json& value) {
  return {pointer, [=](GltfMaker& maker) { maker.root[json::json_pointer(pointer)] = value; }};
}

Hostile drop(const char* pointer, const char* key) {
  return {pointer, [=](GltfMaker& maker) { maker.root[json::json_pointer(pointer)].erase(key); }};
}

constexpr std::uint64_t kHuge = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kWraps = (1ull << 32) + 1;  // becomes 1 if truncated to 32 bits

const std::vector<Hostile>& hostile_files() {
  static const std::vector<Hostile> files{
      // Faults in the asset and the top-level lists.
      drop("", "asset"),
      set("/asset/version", "1.0"),
      set("/asset/version", 2),
      set("/asset", "2.0"),
      set("/asset/minVersion", "2.9"),
      set("/asset/minVersion", 2),
      set("/accessors", "three"),
      set("/nodes", json::object()),
      set("/meshes/0", 7),
      set("/extensionsRequired", {"X\n\x1b[31m"}),
      set("/extensionsUsed", {1}),
      set("/buffers", 1),
      // Buffer views.
      set("/bufferViews/0/byteOffset", kHuge),
      set("/bufferViews/0/byteLength", kHuge),
      set("/bufferViews/0/byteLength", 0),
      set("/bufferViews/0/byteLength", -4),
      set("/bufferViews/0/byteOffset", kHuge - 10),
      set("/bufferViews/0/buffer", kWraps),
      set("/bufferViews/0/buffer", 1),
      set("/bufferViews/0/byteStride", 2),
      set("/bufferViews/0/byteStride", 6),
      set("/bufferViews/0/byteStride", 252),
      set("/bufferViews/0/byteOffset", 1.5),
      drop("/bufferViews/0", "byteLength"),
      // Accessors.
      set("/accessors/0/count", kHuge),
      set("/accessors/0/count", 1ull << 32),
      set("/accessors/0/count", 0),
      set("/accessors/0/count", -1),
      set("/accessors/0/count", 4),
      set("/accessors/0/byteOffset", kHuge),
      set("/accessors/0/byteOffset", 8),
      set("/accessors/0/componentType", 5124),
      set("/accessors/0/componentType", 5130),
      set("/accessors/0/type", "VEC5"),
      set("/accessors/0/type", 3),
      set("/accessors/0/bufferView", 99),
      set("/accessors/0/bufferView", kWraps),
      set("/accessors/0/normalized", 1),
      set("/accessors/6/bufferView", nullptr),
      drop("/accessors/6", "bufferView"),
      set("/accessors/6/count", 2),
      set("/accessors/6/normalized", true),
      set("/accessors/2/sparse/count", 4),
      set("/accessors/2/sparse/count", kWraps),
      set("/accessors/2/sparse/indices/componentType", f32),
      set("/accessors/2/sparse/indices/bufferView", 99),
      set("/accessors/2/sparse/values/byteOffset", kWraps - 1),
      set("/accessors/2/sparse", json::array()),
      // Meshes.
      set("/meshes/0/primitives", json::array()),
      drop("/meshes/0", "primitives"),
      set("/meshes/0/primitives/0/attributes/POSITION", 99),
      set("/meshes/0/primitives/0/attributes/POSITION", -1),
      drop("/meshes/0/primitives/0/attributes", "POSITION"),
      set("/meshes/0/primitives/0/attributes/NORMAL", 2),
      set("/meshes/0/primitives/0/attributes/TANGENT", 0),
      set("/meshes/0/primitives/0/attributes/POSITION", 2),
      set("/meshes/0/primitives/0/attributes/NORMAL", 6),
      set("/meshes/0/primitives/0/attributes", {0, 1}),
      set("/meshes/0/primitives/0/indices", 0),
      set("/meshes/0/primitives/0/indices", 99),
      set("/meshes/0/primitives/0/material", 1),
      set("/meshes/0/primitives/0/mode", 7),
      drop("/meshes/0/primitives/0/attributes", "JOINTS_0"),
      drop("/meshes/0/primitives/0/attributes", "WEIGHTS_0"),
      // Nodes and scenes.
      set("/nodes/1/children", {1}),
      set("/nodes/2/children", {1}),
      set("/nodes/0/children", {2}),
      set("/nodes/1/children", {0, 0}),
      set("/nodes/1/children", {9}),
      set("/nodes/0/mesh", 2),
      set("/nodes/0/skin", 1),
      set("/nodes/1/rotation", {0, 0, 0, 0}),
      set("/nodes/1/rotation", {0, 0, 1}),
      set("/nodes/1/translation", {0, 1e39, 0}),
      set("/nodes/1/translation", {0, "1", 0}),
      set("/nodes/2/matrix", json::array({1, 2})),
      set("/nodes/2/matrix", {1, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1}),
      {"scales that multiply to infinity",
       [](GltfMaker& maker) {
         maker.root["nodes"][0]["scale"] = maker.root["nodes"][1]["scale"] = {1e30, 1e30, 1e30};
       }},
      set("/nodes/0/name", 5),
      set("/scenes/0/nodes", {0}),
      set("/scenes/0/nodes", {9}),
      set("/scene", 2),
      set("/scene", "0"),
      // Skins.
      set("/skins/0/joints", json::array()),
      set("/skins/0/joints", {9}),
      set("/skins/0/inverseBindMatrices", 0),
      set("/skins/0/inverseBindMatrices", 99),
      set("/skins/0/joints", {1}),
      set("/skins/0/joints", {1, 2, 1}),
      // Materials and textures.
      set("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1}),
      set("/materials/0/pbrMetallicRoughness/roughnessFactor", "0"),
      set("/materials/0/alphaMode", "FOG"),
      set("/materials/0/doubleSided", 1),
      set("/materials/0/normalTexture/index", 2),
      set("/materials/0/normalTexture/index", kWraps),
      drop("/materials/0/normalTexture", "index"),
      set("/materials/0/normalTexture", 0),
      set("/materials/0/normalTexture/extensions/KHR_texture_transform/offset", {1}),
      set("/materials/0/normalTexture/extensions/KHR_texture_transform", "flip"),
      set("/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", {2}),
      set("/textures/0/source", 2),
      set("/textures/0/sampler", 1),
      set("/samplers/0/wrapS", -1),
      set("/images/0/bufferView", 99),
      set("/images/0/bufferView", 0),
      set("/images/0/uri", "both.png"),
      drop("/images/0", "bufferView"),
      set("/images/1/uri", "none.png"),
      set("/images/1/uri", "data:image/png;base64,!!!!"),
      set("/images/1/uri", "data:image/png;base64,"),
      set("/images/1/uri", "data:image/png,abc"),
      set("/images/1/uri", "../../etc/passwd"),
      set("/images/1/uri", "%zz")};
  return files;
}

}  // namespace

TEST_CASE("the base of the hostile files is valid and complete") {
  const Model model = read_back(everything().glb());
  CHECK(is_valid(model));
  CHECK(model.triangle_count() == 3);
  CHECK(model.textures.size() == 2);
  CHECK(model.nodes.size() == 3);
  CHECK_FALSE(is_rejected(everything().gltf()));
}

TEST_CASE("every hostile file is rejected with one sentence that names it") {
  CHECK(hostile_files().size() >= 40);
  for (const Hostile& file : hostile_files()) {
    GltfMaker maker = everything();
    file.corrupt(maker);
    const std::string text = maker.root.dump();
    CAPTURE(file.name);
    CAPTURE(text);
    if (!maker.root.contains("buffers")) CHECK(is_rejected(maker.gltf()));
    if (!maker.root.contains("buffers")) CHECK(is_rejected(maker.glb()));
    CHECK(is_rejected(text));  // the JSON alone, whose buffer is missing or corrupt
  }
}

TEST_CASE("numbers in the buffer are checked like those in the text") {
  const auto rejected_with = [](std::size_t accessor, std::size_t offset, auto value) {
    GltfMaker maker = everything();
    const json& item = maker.root["accessors"][accessor];
    const std::size_t view = item["bufferView"].get<std::size_t>();
    const std::size_t at = maker.root["bufferViews"][view]["byteOffset"].get<std::size_t>() + offset;
    std::memcpy(maker.bytes.data() + at, &value, sizeof value);
    return is_rejected(maker.glb());
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  CHECK(rejected_with(0, 4, nan));  // a position
  CHECK(rejected_with(0, 4, inf));
  CHECK(rejected_with(1, 0, nan));               // a normal
  CHECK(rejected_with(4, 1, std::uint8_t{2}));   // a joint that the skin does not have
  CHECK(rejected_with(5, 0, -1.0f));             // a weight
  CHECK(rejected_with(6, 2, std::uint16_t{3}));  // an index of a vertex that does not exist
  CHECK(rejected_with(6, 2, std::uint16_t{0xffff}));
  CHECK(rejected_with(7, 0, nan));         // a bind matrix
  CHECK_FALSE(rejected_with(1, 8, 0.0f));  // a normal of zero length is repaired
}

// glTF 2.0 section 3.7.2.1: all attribute accessors of a primitive have the same count.
TEST_CASE("any attribute whose length differs from the positions rejects the file") {
  struct Attribute {
    const char* name;
    const char* type;
    std::size_t components;
  };
  const auto sentence = [](const Attribute& a, std::size_t vertices) {
    GltfMaker maker = triangle();  // three positions
    json& attributes = maker.root["meshes"][0]["primitives"][0]["attributes"];
    // All values are 1, so each attribute is valid except for its length.
    attributes[a.name] = maker.accessor(std::vector<float>(a.components * vertices, 1.0f), a.type, f32);
    try {
      read_back(maker);
      return std::string();
    } catch (const GltfError& e) {
      return std::string(e.what());
    }
  };
  for (const Attribute& a :
       {Attribute{"NORMAL", "VEC3", 3}, Attribute{"TANGENT", "VEC4", 4}, Attribute{"TEXCOORD_0", "VEC2", 2},
        Attribute{"TEXCOORD_1", "VEC2", 2}, Attribute{"COLOR_0", "VEC4", 4}}) {
    CAPTURE(a.name);
    CHECK(sentence(a, 3).empty());
    for (const std::size_t vertices : {1u, 2u, 4u, 300u})
      CHECK(sentence(a, vertices).find("has attributes of different lengths") != std::string::npos);
  }
  for (const std::size_t vertices : {2u, 4u}) {  // wrong number of joints, correct number of weights
    GltfMaker maker = everything();
    json& attributes = maker.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = maker.accessor(std::vector<std::uint8_t>(4 * vertices), "VEC4", u8);
    CHECK(is_rejected(maker.gltf()));
  }
}

TEST_CASE("sparse indices that do not increase, or exceed the accessor, reject the file") {
  for (const std::vector<std::uint8_t>& indices : {std::vector<std::uint8_t>{1, 1}, {2, 0}, {0, 3}, {255, 0}}) {
    GltfMaker maker = triangle();
    const json sparse = {{"count", 2},
                         {"indices", {{"bufferView", maker.view(indices)}, {"componentType", u8}}},
                         {"values", {{"bufferView", maker.view(std::vector<float>(6))}}}};
    maker.root["accessors"][0]["sparse"] = sparse;
    CHECK(is_rejected(maker.gltf()));
  }
}

TEST_CASE("images with a false size, and files that are not images, reject the file") {
  const auto with_picture = [](const std::vector<std::uint8_t>& bytes) {
    GltfMaker maker = everything();
    maker.root["images"][1]["uri"] = data_uri(bytes, "image/png");
    return is_rejected(maker.gltf());
  };
  TempFolder folder;
  write_png(folder / "dot.png", Image{2, 2, std::vector<std::uint8_t>(16, 128)});
  const std::vector<std::uint8_t> good = read_bytes(folder / "dot.png");
  CHECK_FALSE(with_picture(good));
  // A PNG's header stores width and height in bytes 16 to 23, big-endian.
  const auto resized = [&](std::uint8_t b0, std::uint8_t b1, std::uint8_t b2, std::uint8_t b3) {
    std::vector<std::uint8_t> bytes = good;
    const std::uint8_t side[4] = {b0, b1, b2, b3};
    for (std::size_t i = 0; i < 8; ++i) bytes[16 + i] = side[i % 4];
    return bytes;
  };
  CHECK(with_picture(resized(0x7f, 0xff, 0xff, 0xff)));
  CHECK(with_picture(resized(0xff, 0xff, 0xff, 0xff)));
  CHECK(with_picture(resized(0, 0, 0x20, 0x01)));  // 8193
  CHECK(with_picture(resized(0, 0, 0x20, 0)));     // 8192 x 8192 px, but the file contains fewer pixels
  CHECK(with_picture(resized(0, 0, 0, 0)));
  CHECK(with_picture({good.begin(), good.begin() + 30}));
  CHECK(with_picture({'G', 'I', 'F', '8', '9', 'a', 1, 0, 1, 0, 0, 0, 0}));
  CHECK(with_picture({0xff, 0xd8, 0xff, 0xe0}));
  CHECK(with_picture({'n', 'o'}));
}

TEST_CASE("an image in a buffer is read from there, however often it is referenced") {
  const TempFolder folder;
  write_bytes(folder / "model.gltf", everything().gltf());
  GltfDocument document = open_gltf(folder / "model.gltf");
  const std::vector<std::uint8_t>& buffer = document.buffers.front();
  const auto bytes = image_bytes(document, 0);
  CHECK(bytes.data() > buffer.data());
  CHECK(bytes.data() + bytes.size() <= buffer.data() + buffer.size());
  CHECK(document.images.empty());
  const auto in_data_uri = image_bytes(document, 1);
  REQUIRE(document.images.size() == 1);
  CHECK(in_data_uri.data() == document.images.front().data());
}

TEST_CASE("skins with too many matrices reject the file before they are read") {
  GltfMaker maker = everything();
  maker.root["accessors"].push_back({{"componentType", f32}, {"count", 60'000}, {"type", "MAT4"}});
  const std::size_t zeros = maker.root["accessors"].size() - 1;
  maker.root["skins"][0]["inverseBindMatrices"] = zeros;
  CHECK_FALSE(is_rejected(maker.gltf()));
  maker.root["accessors"][zeros]["count"] = 70'000;
  CHECK(is_rejected(maker.gltf()));
}

TEST_CASE("text that is not glTF is rejected with one sentence") {
  const std::string deep(1'000'000, '[');
  std::string many = R"({"asset":{"version":"2.0"},"extras":[0)";
  for (std::uint64_t i = 0; i < kMaxGltfValues; ++i) many += ",0";
  const std::string texts[] = {"",
                               " ",
                               "{",
                               "null",
                               "[]",
                               "glTF",
                               "hello",
                               deep,
                               deep + std::string(1'000'000, ']'),
                               R"({"asset":{"version":"2.0","extras":)" + std::string(100'000, '{'),
                               R"({"asset":{"version":"2.0"},"x":1e999})",
                               "{\"asset\":{\"version\":\"2.0\xff\xfe\"}}",
                               std::string("{\"asset\"\0:{}}", 13),
                               R"({"asset":{"version":"2.0"}} trailing)",
                               std::string(10'000, '\0'),
                               many + "]}"};
  for (const std::string& text : texts) {
    CAPTURE(text.substr(0, 60));
    CHECK(is_rejected(text));
  }
  CHECK_FALSE(is_rejected(R"({"asset":{"version":"2.0"}})"));  // empty, but valid
}

TEST_CASE("a .glb with a false header or chunk size is rejected with one sentence") {
  const std::string good = everything().glb();
  const auto with_integer = [&](std::size_t at, std::size_t value) {
    return std::string(good).replace(at, 4, GltfMaker::little_endian(value));
  };
  std::uint32_t json_length = 0;
  std::memcpy(&json_length, good.data() + 12, 4);
  const std::size_t binary = 20 + json_length;
  for (const std::string& file :
       {with_integer(4, 1), with_integer(4, 3), with_integer(8, 0), with_integer(8, 11), with_integer(8, 20),
        with_integer(8, good.size() + 1), with_integer(8, 0xffffffff), with_integer(12, 0xffffffff),
        with_integer(12, 0), with_integer(12, json_length - 4), with_integer(12, json_length + 4),
        with_integer(12, good.size()), with_integer(16, 0x004E4942), with_integer(binary, 0xffffffff),
        with_integer(binary, good.size() - binary), with_integer(binary, 4), with_integer(binary + 4, 0x12345678)}) {
    CHECK(is_rejected(file));
  }
}

TEST_CASE("a file truncated anywhere is rejected") {
  for (const std::string& content : {everything().glb(), everything().gltf()}) {
    for (std::size_t size = 0; size < content.size(); size += 2) CHECK(is_rejected(content.substr(0, size)));
  }
}

TEST_CASE("a file with any bytes changed is rejected or gives a valid model") {
  const std::string good = everything().glb();
  const std::size_t binary = good.size() - everything().bytes.size();
  std::mt19937_64 random(20260101);
  int refused = 0;
  for (int i = 0; i < kByteFlips; ++i) {
    std::string bad = good;
    const std::size_t first = i % 2 == 0 ? 0 : binary;  // changes bytes anywhere, or only in the binary data
    for (std::uint64_t k = 0; k <= random() % 8; ++k) {
      bad[first + random() % (bad.size() - first)] = static_cast<char>(random());
    }
    if (is_rejected(bad)) ++refused;
  }
  MESSAGE(refused, " of ", kByteFlips, " refused");
  CHECK(refused > kByteFlips / 10);
  CHECK(refused < kByteFlips);
}

TEST_CASE("a file with any values exchanged is rejected or gives a valid model") {
  const json values[] = {-1,         0,           1,     2,      3,    5,     255,           65536,
                         1000000000, kWraps,      kHuge, -1.5,   1e38, -1e38, 1e-45,         0.5,
                         nullptr,    true,        "",    "VEC4", 5123, 5126,  json::array(), json::object(),
                         {0, 1, 2},  {1, 1, 1, 1}};
  const GltfMaker good = everything();
  const json flat = good.root.flatten();
  std::vector<std::string> pointers;
  for (const auto& [pointer, value] : flat.items()) pointers.push_back(pointer);
  std::mt19937_64 random(20260102);
  int refused = 0;
  for (int i = 0; i < kValueSwaps; ++i) {
    GltfMaker bad = good;
    for (std::uint64_t k = 0; k <= random() % 3; ++k) {
      const json::json_pointer pointer(pointers[random() % pointers.size()]);
      // Replaces the value itself, or sometimes the list or object that contains it.
      const json::json_pointer target = random() % 4 == 0 ? pointer.parent_pointer() : pointer;
      if (bad.root.contains(target) && !target.empty()) bad.root[target] = values[random() % std::size(values)];
    }
    if (is_rejected(random() % 2 == 0 ? bad.gltf() : bad.glb())) ++refused;
  }
  MESSAGE(refused, " of ", kValueSwaps, " refused");
  CHECK(refused > kValueSwaps / 10);
  CHECK(refused < kValueSwaps);
}

TEST_CASE("a path that is not a file is rejected") {
  TempFolder folder;
  for (const std::filesystem::path& path :
       {folder / "none.glb", folder.path(), std::filesystem::path("/dev/zero"), std::filesystem::path()}) {
    CAPTURE(path.string());
    CHECK_THROWS_AS(read_gltf(path), GltfError);
  }
}
