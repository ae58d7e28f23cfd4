#include "engine/model/gltf_check.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

#include "engine/model/gltf.h"
#include "engine/model/gltf_bytes.h"
#include "engine/model/gltf_extensions.h"
#include "engine/model/json_item.h"

namespace gearshift::engine {

namespace {

// glTF's component types.
enum Component : std::uint64_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

// Returns the bytes per component (glTF 2.0, section 3.6.2.2); 0 for an unknown type.
std::uint64_t component_bytes(std::uint64_t type) {
  switch (type) {
    case i8:
    case u8:
      return 1;
    case i16:
    case u16:
      return 2;
    case u32:
    case f32:
      return 4;
    default:
      return 0;
  }
}

// Returns the components per element (glTF 2.0, section 3.6.2.3); 0 for an unknown type.
std::uint64_t component_count(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::uint64_t>, 7> counts{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  const auto* found = std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == type; });
  return found == counts.end() ? 0 : found->second;
}

struct Accessor {
  std::string type;
  std::uint64_t component = 0;
  std::uint64_t count = 0;
  bool normalized = false;
  bool stored = false;  // true: the elements are in a buffer view; false: all are zero
};

// Checks the top-level lists of the file. A list is checked after the lists to which it refers.
class Check {
 public:
  Check(const nlohmann::json& json, std::size_t binary_bytes) : root_(json, ""), binary_bytes_(binary_bytes) {}

  void all() {
    check_asset();
    check_extensions();
    check_buffers();
    check_views();
    for (const JsonItem& item : root_.items("accessors")) accessors_.push_back(checked_accessor(item));
    check_textures();
    for (const JsonItem& item : root_.items("materials")) check_material(item);
    check_meshes();
    check_nodes();
    check_skins();
    check_scenes();
  }

 private:
  void check_asset() {
    const JsonItem asset = root_.required_item("asset");
    const std::string version = asset.required_text("version");
    if (!version.starts_with("2."))
      throw GltfError(fmt::format("the file is glTF {}, not 2.0", printable_name(version)));
    // Only a reader that supports `minVersion` may read the file (glTF 2.0, section 5.8).
    const std::string needs = asset.text("minVersion").value_or("2.0");
    if (needs != "2.0")
      throw GltfError(fmt::format("the file needs glTF {}, but only 2.0 is supported", printable_name(needs)));
  }

  void check_extensions() {
    root_.texts("extensionsUsed");
    for (const std::string& name : root_.texts("extensionsRequired")) {
      if (!is_supported_extension(name))
        throw GltfError(fmt::format("the file requires {}, which is not supported", printable_name(name)));
    }
  }

  void check_buffers() {
    std::uint64_t total = 0;
    for (const JsonItem& item : root_.items("buffers")) {
      const std::uint64_t size = item.required_integer("byteLength", 1, kMaxGltfBytes);
      const bool in_chunk = buffer_bytes_.empty() && binary_bytes_ > 0 && !item.has("uri");
      if (in_chunk && size > binary_bytes_) item.reject("is longer than the binary chunk");
      if (!in_chunk) item.required_text("uri");
      total += size;
      if (total > kMaxGltfBytes) throw GltfError("the buffers are too large in total");
      buffer_bytes_.push_back(size);
    }
  }

  void check_views() {
    for (const JsonItem& item : root_.items("bufferViews")) {
      const std::uint64_t buffer_size = buffer_bytes_[item.required_index("buffer", buffer_bytes_.size())];
      const std::uint64_t offset = item.integer("byteOffset", 0, buffer_size).value_or(0);
      const std::uint64_t length = item.required_integer("byteLength", 1, kMaxGltfBytes);
      if (length > buffer_size - offset) item.reject("extends beyond its buffer");
      const std::uint64_t stride = item.integer("byteStride", 4, 252).value_or(0);
      if (stride % 4 != 0) item.reject("has a stride that is not a multiple of 4");
      views_.push_back({length, stride});
    }
  }

  // Rejects the item if `count` elements, starting at the item's `byteOffset`, do not fit into its buffer view.
  void check_range(const JsonItem& item, std::uint64_t count, std::uint64_t element) const {
    const View& view = views_[item.required_index("bufferView", views_.size())];
    const std::uint64_t offset = item.integer("byteOffset", 0, view.length).value_or(0);
    const std::uint64_t stride = view.stride == 0 ? element : view.stride;
    if (stride < element) item.reject("has elements longer than their stride");
    // The product cannot overflow: count is below 2^24 and stride is below 2^8.
    if ((count - 1) * stride + element > view.length - offset) item.reject("extends beyond its buffer view");
  }

  Accessor checked_accessor(const JsonItem& item) const {
    Accessor accessor;
    accessor.type = item.required_text("type");
    accessor.component = item.required_integer("componentType", i8, f32);
    accessor.count = item.required_integer("count", 1, kMaxGltfElements);
    const std::uint64_t element = component_count(accessor.type) * component_bytes(accessor.component);
    if (element == 0) item.reject("has a type that glTF does not define");
    accessor.normalized = item.flag("normalized");
    if (item.has("bufferView")) check_range(item, accessor.count, element);
    if (const auto sparse = item.item("sparse")) check_sparse(*sparse, accessor.count, element);
    accessor.stored = item.has("bufferView");
    return accessor;
  }

  void check_sparse(const JsonItem& sparse, std::uint64_t max_count, std::uint64_t element) const {
    const std::uint64_t count = sparse.required_integer("count", 1, max_count);
    const JsonItem indices = sparse.required_item("indices");
    const std::uint64_t type = indices.required_integer("componentType", u8, u32);
    if (type != u8 && type != u16 && type != u32) indices.reject("has a type that indices cannot have");
    check_range(indices, count, component_bytes(type));
    check_range(sparse.required_item("values"), count, element);
  }

  void check_textures() {
    const std::vector<JsonItem> images = root_.items("images");
    for (const JsonItem& item : images) {
      if (item.has("uri") == item.has("bufferView")) item.reject("needs either a URI or a buffer view");
      item.text("uri");
      item.index("bufferView", views_.size());
    }
    const std::vector<JsonItem> samplers = root_.items("samplers");
    for (const JsonItem& item : samplers) {
      for (const char* key : {"magFilter", "minFilter", "wrapS", "wrapT"}) item.integer(key, 0, 0xffff);
    }
    for (const JsonItem& item : root_.items("textures")) {
      item.index("source", images.size());
      item.index("sampler", samplers.size());
      ++textures_;
    }
  }

  void check_texture_use(const JsonItem& parent, const char* key) const {
    const auto use = parent.item(key);
    if (!use) return;
    use->required_index("index", textures_);
    use->integer("texCoord", 0, 0xffff);
    use->number("scale");
    use->number("strength");
    const auto extensions = use->item("extensions");
    const auto transform = extensions ? extensions->item(kTextureTransform) : std::nullopt;
    if (!transform) return;
    transform->numbers("offset", 2);
    transform->numbers("scale", 2);
    transform->number("rotation");
    transform->integer("texCoord", 0, 0xffff);
  }

  void check_material(const JsonItem& item) {
    ++materials_;
    item.text("name");
    item.numbers("emissiveFactor", 3);
    item.number("alphaCutoff");
    item.flag("doubleSided");
    const std::string mode = item.text("alphaMode").value_or("OPAQUE");
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") item.reject("has an unknown alpha mode");
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) check_texture_use(item, key);
    if (const auto surface = item.item("pbrMetallicRoughness")) {
      surface->numbers("baseColorFactor", 4);
      surface->number("metallicFactor");
      surface->number("roughnessFactor");
      for (const char* key : {"baseColorTexture", "metallicRoughnessTexture"}) check_texture_use(*surface, key);
    }
    if (const auto extensions = item.item("extensions")) {
      const auto emissive = extensions->item(kEmissiveStrength);
      if (emissive) emissive->number("emissiveStrength");
    }
  }

  void check_meshes() {
    for (const JsonItem& item : root_.items("meshes")) {
      ++meshes_;
      item.text("name");
      const std::vector<JsonItem> primitives = item.items("primitives");
      if (primitives.empty()) item.reject("has no primitives");
      for (const JsonItem& primitive : primitives) check_primitive(primitive);
    }
  }

  void check_primitive(const JsonItem& item) {
    item.index("material", materials_);
    const std::uint64_t mode = item.integer("mode", 0, 6).value_or(4);
    const std::uint64_t vertices = checked_attributes(item);
    std::uint64_t corners = vertices;
    if (const auto index = item.index("indices", accessors_.size())) {
      const Accessor& indices = accessors_[*index];
      const bool typed = indices.component == u8 || indices.component == u16 || indices.component == u32;
      if (indices.type != "SCALAR" || !typed || indices.normalized) item.reject("has indices that are not integers");
      if (!indices.stored) item.reject("has indices without a buffer view");
      corners = indices.count;
    }
    if (mode == 4 && corners % 3 != 0) item.reject("is not a whole number of triangles");
    if (mode > 4 && corners < 3) item.reject("is not a triangle");
    if (mode > 4) corners = 3 * (corners - 2);
    elements_ += std::max(vertices, corners);
    if (elements_ > kMaxGltfElements) throw GltfError("the file has too many vertices or indices");
  }

  // Checks a primitive's attributes; returns the number of vertices.
  std::uint64_t checked_attributes(const JsonItem& item) const {
    const auto attributes = item.named_indices("attributes", accessors_.size());
    const auto position =
        std::find_if(attributes.begin(), attributes.end(), [](const auto& a) { return a.first == "POSITION"; });
    if (position == attributes.end()) item.reject("has no positions");
    for (const auto& [name, index] : attributes) {
      if (!is_allowed_type(name, accessors_[index])) {
        item.reject(fmt::format("has a {} of a type that glTF does not allow", printable_name(name)));
      }
      if (accessors_[index].count != accessors_[position->second].count) {
        item.reject("has attributes of different lengths");
      }
    }
    return accessors_[position->second].count;
  }

  // Returns whether the type of an attribute is allowed (table in glTF 2.0, section 3.7.2.1). Attributes that are not
  // in the table are allowed, because gltf.cpp does not read them.
  static bool is_allowed_type(std::string_view name, const Accessor& a) {
    const bool is_float = a.component == f32;
    const bool is_fraction = is_float || ((a.component == u8 || a.component == u16) && a.normalized);
    if (name == "POSITION" || name == "NORMAL") return a.type == "VEC3" && is_float;
    if (name == "TANGENT") return a.type == "VEC4" && is_float;
    if (name.starts_with("TEXCOORD_")) return a.type == "VEC2" && is_fraction;
    if (name.starts_with("COLOR_")) return (a.type == "VEC3" || a.type == "VEC4") && is_fraction;
    if (name.starts_with("WEIGHTS_")) return a.type == "VEC4" && is_fraction;
    if (name.starts_with("JOINTS_"))
      return a.type == "VEC4" && (a.component == u8 || a.component == u16) && !a.normalized;
    return true;
  }

  void check_nodes() {
    const std::vector<JsonItem> nodes = root_.items("nodes");
    const std::size_t skins = root_.items("skins").size();
    has_parent_.assign(nodes.size(), false);
    std::vector<std::vector<std::size_t>> children;
    for (const JsonItem& item : nodes) {
      item.text("name");
      item.index("mesh", meshes_);
      item.index("skin", skins);
      item.numbers("matrix", 16);
      item.numbers("translation", 3);
      item.numbers("rotation", 4);
      item.numbers("scale", 3);
      children.push_back(item.indices("children", nodes.size()));
      for (const std::size_t child : children.back()) {
        if (has_parent_[child]) throw GltfError(fmt::format("nodes[{}] has two parents", child));
        has_parent_[child] = true;
      }
    }
    check_no_cycle(children);
  }

  // Each node has at most one parent. So a node that cannot be reached from a root is on a cycle or below one.
  void check_no_cycle(const std::vector<std::vector<std::size_t>>& children) const {
    std::vector<std::size_t> reached;
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (!has_parent_[i]) reached.push_back(i);
    }
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (const std::size_t child : children[reached[i]]) reached.push_back(child);
    }
    if (reached.size() != children.size()) throw GltfError("the node hierarchy contains a cycle");
  }

  void check_skins() const {
    constexpr std::size_t max_joints = 0xffff;
    for (const JsonItem& item : root_.items("skins")) {
      const std::vector<std::size_t> joints = item.indices("joints", has_parent_.size());
      if (joints.empty() || joints.size() > max_joints) item.reject("has no joints, or too many");
      const auto index = item.index("inverseBindMatrices", accessors_.size());
      if (!index) continue;
      const Accessor& matrices = accessors_[*index];
      if (matrices.type != "MAT4" || matrices.component != f32 || matrices.count < joints.size()) {
        item.reject("does not have one bind matrix per joint");
      }
    }
  }

  void check_scenes() const {
    const std::vector<JsonItem> scenes = root_.items("scenes");
    for (const JsonItem& item : scenes) {
      for (const std::size_t node : item.indices("nodes", has_parent_.size())) {
        if (has_parent_[node]) item.reject(fmt::format("has node {}, which is not a root", node));
      }
    }
    root_.index("scene", scenes.size());
  }

  struct View {
    std::uint64_t length = 0, stride = 0;  // stride 0: not specified
  };
  JsonItem root_;
  std::size_t binary_bytes_;
  std::vector<std::uint64_t> buffer_bytes_;
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
  std::size_t textures_ = 0, materials_ = 0, meshes_ = 0;
  std::vector<bool> has_parent_;  // by node
  std::uint64_t elements_ = 0;
};

}  // namespace

void check_gltf(const nlohmann::json& root, std::size_t binary_bytes) {
  Check(root, binary_bytes).all();
}

}  // namespace gearshift::engine
