// Builds a Model from a checked document, using tinygltf's structs. This is the only file that includes tinygltf.
// tinygltf gets only JSON that check_gltf() has accepted, and no files, buffers or images. Its own loader has three
// defects: it may read images beyond the end of their buffers, reads eight bytes beyond a binary chunk, and opens files
// in the working folder.
#include "engine/model/gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

#include "engine/model/accessor.h"
#include "engine/model/gltf_bytes.h"
#include "engine/model/gltf_document.h"
#include "engine/model/gltf_extensions.h"
#include "engine/model/image_decode.h"
#include "engine/model/node_transform.h"
#include "engine/model/surface.h"

namespace gearshift::engine {

namespace {

template <typename List>
decltype(auto) at(List& list, int index) {
  return list[static_cast<std::size_t>(index)];
}

tinygltf::Model parse_structs(const GltfDocument& document) {
  nlohmann::json known = nlohmann::json::object();
  for (const char* key : {"asset", "bufferViews", "accessors", "meshes", "nodes", "scenes", "scene", "materials",
                          "textures", "samplers", "skins"}) {
    if (document.json.contains(key)) known[key] = document.json[key];
  }
  const std::string text = known.dump();
  tinygltf::Model model;
  std::string errors, warnings;
  if (!tinygltf::TinyGLTF().LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                                static_cast<unsigned>(text.size()), "")) {
    throw GltfError(fmt::format("the glTF parser failed: {}", printable_name(errors)));
  }
  return model;
}

float clamped(double value) {
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

class GltfReader {
 public:
  explicit GltfReader(const std::filesystem::path& file)
      : document_(open_gltf(file)), source_(parse_structs(document_)) {}

  Model read() {
    list_skipped();
    for (const tinygltf::Material& material : source_.materials) model_.materials.push_back(read_material(material));
    read_textures();
    read_nodes();
    read_skins();
    for (const tinygltf::Mesh& mesh : source_.meshes) read_mesh(mesh);
    check_joints();
    if (drop_flat_meshes(model_)) skip("meshes scaled flat or out of range");
    model_.skipped.assign(skipped_.begin(), skipped_.end());
    model_.files = std::move(document_.files);
    return std::move(model_);
  }

 private:
  void skip(std::string what) { skipped_.insert(std::move(what)); }

  void list_skipped() {
    const nlohmann::json& json = document_.json;
    if (json.contains("extensionsUsed")) {
      for (const std::string name : json["extensionsUsed"]) {
        if (!is_supported_extension(name)) skip(fmt::format("extension {}", printable_name(name)));
      }
    }
    if (json.contains("animations")) skip("animations");
    if (json.contains("cameras")) skip("cameras");
    if (source_.scenes.size() > 1) skip("scenes other than the default one");
  }

  // --- materials ---

  Material read_material(const tinygltf::Material& in) {
    const tinygltf::PbrMetallicRoughness& surface = in.pbrMetallicRoughness;
    Material out;
    out.name = in.name;
    for (int i = 0; i < 4; ++i) out.base_colour[i] = clamped(at(surface.baseColorFactor, i));
    out.metallic = clamped(surface.metallicFactor);
    out.roughness = clamped(surface.roughnessFactor);
    out.normal_scale = static_cast<float>(in.normalTexture.scale);
    out.occlusion_strength = clamped(in.occlusionTexture.strength);
    for (int i = 0; i < 3; ++i) out.emissive[i] = clamped(at(in.emissiveFactor, i)) * emissive_strength(in);
    if (in.alphaMode == "MASK") out.alpha_mode = AlphaMode::mask;
    if (in.alphaMode == "BLEND") out.alpha_mode = AlphaMode::blend;
    out.alpha_cutoff = static_cast<float>(std::max(0.0, in.alphaCutoff));
    out.double_sided = in.doubleSided;
    out.base_colour_map = texture_use(surface.baseColorTexture, true);
    out.metal_rough_map = texture_use(surface.metallicRoughnessTexture, false);
    out.normal_map = texture_use(in.normalTexture, false);
    out.occlusion_map = texture_use(in.occlusionTexture, false);
    out.emissive_map = texture_use(in.emissiveTexture, true);
    return out;
  }

  static float emissive_strength(const tinygltf::Material& in) {
    const auto found = in.extensions.find(kEmissiveStrength);
    if (found == in.extensions.end() || !found->second.Has("emissiveStrength")) return 1.0f;
    return static_cast<float>(std::max(0.0, found->second.Get("emissiveStrength").GetNumberAsDouble()));
  }

  template <typename TextureInfo>  // tinygltf has three types of texture use with the same members
  TextureUse texture_use(const TextureInfo& in, bool srgb) {
    TextureUse out;
    if (in.index == -1) return out;
    int uv_set = in.texCoord;
    const auto transform = in.extensions.find(kTextureTransform);
    if (transform != in.extensions.end()) uv_set = read_transform(transform->second, out, uv_set);
    if (uv_set > 1) {
      skip("textures with a UV set beyond the second");
      return TextureUse{};
    }
    out.uv_set = uv_set;
    out.texture = texture(in.index, srgb);
    return out;
  }

  // Reads the values of KHR_texture_transform. Returns the UV set, which the extension may override.
  static int read_transform(const tinygltf::Value& in, TextureUse& out, int uv_set) {
    const auto number = [](const tinygltf::Value& v) { return static_cast<float>(v.GetNumberAsDouble()); };
    if (in.Has("offset")) out.offset = {number(in.Get("offset").Get(0)), number(in.Get("offset").Get(1))};
    if (in.Has("scale")) out.scale = {number(in.Get("scale").Get(0)), number(in.Get("scale").Get(1))};
    if (in.Has("rotation")) out.rotation = number(in.Get("rotation"));
    return in.Has("texCoord") ? in.Get("texCoord").GetNumberAsInt() : uv_set;
  }

  // --- textures: one for each combination of image, sampler and colour space that the materials use ---

  int texture(int index, bool srgb) {
    const tinygltf::Texture& in = at(source_.textures, index);
    if (in.source == -1) {
      skip("textures without a PNG or JPEG image");
      return kNone;
    }
    Texture out;
    out.srgb = srgb;
    if (in.sampler != -1) read_sampler(at(source_.samplers, in.sampler), out);
    const auto key = std::tuple(in.source, srgb, out.wrap_u, out.wrap_v, out.linear);
    const auto [known, is_new] = textures_.try_emplace(key, static_cast<int>(model_.textures.size()));
    if (is_new) {
      model_.textures.push_back(std::move(out));
      image_of_texture_.push_back(in.source);
    }
    return known->second;
  }

  static void read_sampler(const tinygltf::Sampler& in, Texture& out) {
    const auto wrap = [](int mode) {
      if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
      return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
    };
    out.wrap_u = wrap(in.wrapS);
    out.wrap_v = wrap(in.wrapT);
    out.linear = in.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST;
  }

  void read_textures() {
    std::map<int, std::size_t> encoded_index;  // image in the file -> index in `encoded`
    std::vector<EncodedImage> encoded;
    for (const int image : image_of_texture_) {
      const auto [known, is_new] = encoded_index.try_emplace(image, encoded.size());
      if (is_new) {
        const auto index = static_cast<std::size_t>(image);
        encoded.push_back({fmt::format("images[{}]", index), image_bytes(document_, index), 0});
      }
      ++encoded[known->second].uses;
    }
    std::vector<Image> images = decode_images(encoded);
    for (std::size_t i = 0; i < model_.textures.size(); ++i) {
      const std::size_t from = encoded_index.at(image_of_texture_[i]);
      const bool last = --encoded[from].uses == 0;
      model_.textures[i].pixels = last ? std::move(images[from]) : images[from];
    }
  }

  // --- nodes of the scene, parents first ---

  void read_nodes() {
    model_index_of_node_.assign(source_.nodes.size(), kNone);
    std::vector<std::pair<int, int>> pending;  // index of a node in the file, index of its parent in the model
    const std::vector<int> roots = scene_roots();
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.emplace_back(*root, kNone);
    while (!pending.empty()) {
      const auto [index, parent] = pending.back();
      pending.pop_back();
      if (at(model_index_of_node_, index) != kNone) continue;  // a scene may list a root node twice
      at(model_index_of_node_, index) = static_cast<int>(model_.nodes.size());
      const tinygltf::Node& in = at(source_.nodes, index);
      model_.nodes.push_back(read_node(in, index, parent));
      for (auto child = in.children.rbegin(); child != in.children.rend(); ++child) {
        pending.emplace_back(*child, at(model_index_of_node_, index));
      }
    }
  }

  std::vector<int> scene_roots() const {
    if (!source_.scenes.empty()) return at(source_.scenes, std::max(0, source_.defaultScene)).nodes;
    std::vector<int> roots(source_.nodes.size());
    for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = static_cast<int>(i);
    for (const tinygltf::Node& node : source_.nodes) {
      for (const int child : node.children) at(roots, child) = kNone;
    }
    roots.erase(std::remove(roots.begin(), roots.end(), kNone), roots.end());
    return roots;
  }

  Node read_node(const tinygltf::Node& in, int index, int parent) const {
    const auto reject = [&](const char* why) { throw GltfError(fmt::format("nodes[{}] {}", index, why)); };
    Node out;
    out.name = in.name;
    out.parent = parent;
    out.mesh = in.mesh;
    out.skin = in.mesh == kNone ? kNone : in.skin;
    if (!in.matrix.empty()) {
      glm::dmat4 matrix;
      std::copy(in.matrix.begin(), in.matrix.end(), glm::value_ptr(matrix));  // both are column-major
      if (!set_node_transform(matrix, out))
        reject("has a matrix that is not a combination of translation, rotation and scale");
    }
    if (!in.translation.empty()) out.translation = vec3_of(in.translation);
    if (!in.scale.empty()) out.scale = vec3_of(in.scale);
    if (!in.rotation.empty()) {
      const std::vector<double>& r = in.rotation;
      const glm::dquat q(r[3], r[0], r[1], r[2]);
      if (!(glm::length(q) > 1e-6)) reject("has a rotation of length zero");
      out.rotation = glm::quat(glm::normalize(q));
    }
    return out;
  }

  static glm::vec3 vec3_of(const std::vector<double>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
  }

  // --- meshes ---

  AccessorData accessor(int index) const {
    const tinygltf::Accessor& in = at(source_.accessors, index);
    AccessorData out;
    out.count = in.count;
    out.components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(in.type)));
    out.type = static_cast<ComponentType>(in.componentType);
    out.normalized = in.normalized;
    const std::size_t element = out.components * byte_size(out.type);
    if (in.bufferView != -1) out.elements = strided(in.bufferView, in.byteOffset, element);
    if (!in.sparse.isSparse) return out;
    out.sparse_count = static_cast<std::size_t>(in.sparse.count);
    out.sparse_type = static_cast<ComponentType>(in.sparse.indices.componentType);
    out.sparse_indices = strided(in.sparse.indices.bufferView, static_cast<std::size_t>(in.sparse.indices.byteOffset),
                                 byte_size(out.sparse_type));
    out.sparse_values =
        strided(in.sparse.values.bufferView, static_cast<std::size_t>(in.sparse.values.byteOffset), element);
    return out;
  }

  StridedData strided(int view_index, std::size_t offset, std::size_t element) const {
    const tinygltf::BufferView& view = at(source_.bufferViews, view_index);
    return {at(document_.buffers, view.buffer).data() + view.byteOffset + offset,
            view.byteStride == 0 ? element : view.byteStride};
  }

  void read_mesh(const tinygltf::Mesh& in) {
    Mesh out;
    out.name = in.name;
    out.first_vertex = static_cast<std::uint32_t>(model_.vertices.size());
    for (const tinygltf::Primitive& primitive : in.primitives) {
      if (!primitive.targets.empty()) skip("morph targets");
      if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        skip(primitive.mode == TINYGLTF_MODE_POINTS ? "points" : "lines");
        continue;
      }
      append(read_surface(primitive), primitive.material, out);
    }
    out.vertex_count = static_cast<std::uint32_t>(model_.vertices.size()) - out.first_vertex;
    model_.meshes.push_back(std::move(out));
  }

  Surface read_surface(const tinygltf::Primitive& in) {
    Surface out;
    read_attributes(in, out);
    out.indices = triangle_list(read_indices(in, out.vertices.size()), static_cast<TriangleMode>(in.mode));
    const bool has_normals = in.attributes.count("NORMAL") != 0;
    if (has_normals) {
      repair_normals(out);
    } else {
      make_flat_normals(out);
    }
    const TextureUse normal_map = in.material == -1 ? TextureUse{} : at(model_.materials, in.material).normal_map;
    const bool has_tangents = has_normals && in.attributes.count("TANGENT") != 0;
    if (has_tangents || normal_map.texture == kNone) {
      repair_tangents(out);
    } else {
      make_tangents(out, normal_map);
    }
    return out;
  }

  static std::vector<std::uint32_t> consecutive_indices(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    for (std::size_t i = 0; i < count; ++i) indices[i] = static_cast<std::uint32_t>(i);
    return indices;
  }

  std::vector<std::uint32_t> read_indices(const tinygltf::Primitive& in, std::size_t vertices) const {
    if (in.indices == -1) return consecutive_indices(vertices);
    std::vector<std::uint32_t> indices = read_integers(accessor(in.indices));
    const auto beyond = std::find_if(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= vertices; });
    if (beyond != indices.end())
      throw GltfError(fmt::format("a mesh uses vertex {}, but has only {} vertices", *beyond, vertices));
    return indices;
  }

  void read_attributes(const tinygltf::Primitive& in, Surface& out) {
    out.vertices.resize(at(source_.accessors, in.attributes.at("POSITION")).count);
    std::vector<float> weights;
    std::vector<std::uint32_t> joints;
    for (const auto& [name, index] : in.attributes) {
      if (name == "JOINTS_0") {
        joints = read_integers(accessor(index));
      } else if (name == "WEIGHTS_0") {
        weights = read_floats(accessor(index));
      } else if (!read_vertex_attribute(name, index, out.vertices) && !name.starts_with('_')) {
        skip(fmt::format("attribute {}", printable_name(name)));
      }
    }
    if (joints.empty() != weights.empty())
      throw GltfError("a mesh has joints without weights, or weights without joints");
    if (!joints.empty()) out.joints = read_joints(joints, weights);
  }

  bool read_vertex_attribute(const std::string& name, int index, std::vector<Vertex>& out) const {
    const auto store_each = [&](auto store) {
      const AccessorData data = accessor(index);
      const std::vector<float> values = read_floats(data);
      for (std::size_t i = 0; i < out.size(); ++i) store(out[i], &values[i * data.components], data.components);
      return true;
    };
    if (name == "POSITION") return store_each([](Vertex& v, const float* p, auto) { v.position = glm::make_vec3(p); });
    if (name == "NORMAL") return store_each([](Vertex& v, const float* p, auto) { v.normal = glm::make_vec3(p); });
    if (name == "TANGENT") return store_each([](Vertex& v, const float* p, auto) { v.tangent = glm::make_vec4(p); });
    if (name == "TEXCOORD_0") return store_each([](Vertex& v, const float* p, auto) { v.uv0 = glm::make_vec2(p); });
    if (name == "TEXCOORD_1") return store_each([](Vertex& v, const float* p, auto) { v.uv1 = glm::make_vec2(p); });
    if (name == "COLOR_0")
      return store_each([](Vertex& v, const float* p, auto count) { v.colour = packed(p, count); });
    return false;
  }

  static std::uint32_t packed(const float* colour, std::size_t components) {
    std::uint32_t bytes = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const float value = i < components ? std::clamp(colour[i], 0.0f, 1.0f) : 1.0f;
      bytes |= static_cast<std::uint32_t>(std::lround(value * 255.0f)) << 8 * i;
    }
    return bytes;
  }

  static std::vector<VertexJoints> read_joints(const std::vector<std::uint32_t>& joints,
                                               const std::vector<float>& weights) {
    std::vector<VertexJoints> out(joints.size() / 4);
    for (std::size_t i = 0; i < out.size(); ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k) {
        if (weights[4 * i + k] < 0.0f) throw GltfError("a mesh has a negative joint weight");
        sum += weights[4 * i + k];
      }
      if (sum < 1e-6) continue;  // all weights are zero: keep VertexJoints' default
      for (std::size_t k = 0; k < 4; ++k) {
        out[i].weight[k] = static_cast<float>(weights[4 * i + k] / sum);
        const bool used = out[i].weight[k] > 0.0f;
        out[i].joint[k] = used ? static_cast<std::uint16_t>(joints[4 * i + k]) : std::uint16_t{0};
      }
    }
    return out;
  }

  void append(Surface&& surface, int material, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(model_.vertices.size());
    Primitive out;
    out.first_index = static_cast<std::uint32_t>(model_.indices.size());
    out.index_count = static_cast<std::uint32_t>(surface.indices.size());
    out.material = material;
    out.low = out.high = surface.vertices[surface.indices.front()].position;
    for (const std::uint32_t i : surface.indices) {
      out.low = glm::min(out.low, surface.vertices[i].position);
      out.high = glm::max(out.high, surface.vertices[i].position);
      model_.indices.push_back(first + i);
    }
    mesh.primitives.push_back(out);
    model_.vertices.insert(model_.vertices.end(), surface.vertices.begin(), surface.vertices.end());
    if (model_.skins.empty()) return;
    if (surface.joints.empty()) without_joints_.insert(static_cast<int>(model_.meshes.size()));
    surface.joints.resize(surface.vertices.size());
    model_.vertex_joints.insert(model_.vertex_joints.end(), surface.joints.begin(), surface.joints.end());
  }

  // --- skins: a skin that no node of the scene uses remains in the list, but empty ---

  void read_skins() {
    std::set<int> used;
    for (const Node& node : model_.nodes) used.insert(node.skin);
    model_.skins.resize(source_.skins.size());
    std::uint64_t matrices = 0;
    for (std::size_t i = 0; i < source_.skins.size(); ++i) {
      const tinygltf::Skin& in = source_.skins[i];
      if (used.count(static_cast<int>(i)) == 0) continue;
      if (in.inverseBindMatrices != -1) matrices += accessor(in.inverseBindMatrices).count;
      if (matrices > kMaxSkinMatrices) throw GltfError("the skins have too many matrices in total");
      model_.skins[i] = read_skin(in);
    }
  }

  Skin read_skin(const tinygltf::Skin& in) const {
    Skin out;
    for (const int joint : in.joints) {
      if (at(model_index_of_node_, joint) == kNone) throw GltfError("a skin has a joint outside the scene");
      out.joints.push_back(at(model_index_of_node_, joint));
    }
    out.inverse_bind.assign(out.joints.size(), glm::mat4(1.0f));
    if (in.inverseBindMatrices == -1) return out;
    const std::vector<float> values = read_floats(accessor(in.inverseBindMatrices));
    for (std::size_t i = 0; i < out.joints.size(); ++i) out.inverse_bind[i] = glm::make_mat4(&values[16 * i]);
    return out;
  }

  void check_joints() const {
    std::set<std::pair<int, int>> checked;  // pairs of mesh and skin
    for (const Node& node : model_.nodes) {
      if (node.skin == kNone || !checked.emplace(node.mesh, node.skin).second) continue;
      if (without_joints_.count(node.mesh) != 0) throw GltfError("a skinned mesh has no joints");
      const Mesh& mesh = at(model_.meshes, node.mesh);
      const std::size_t joints = at(model_.skins, node.skin).joints.size();
      for (std::uint32_t i = mesh.first_vertex; i < mesh.first_vertex + mesh.vertex_count; ++i) {
        for (const std::uint16_t joint : model_.vertex_joints[i].joint) {
          if (joint >= joints)
            throw GltfError(fmt::format("a mesh uses joint {}, but its skin has only {}", joint, joints));
        }
      }
    }
  }

  std::set<std::string> skipped_;
  std::map<std::tuple<int, bool, Wrap, Wrap, bool>, int> textures_;
  std::vector<int> image_of_texture_;
  std::vector<int> model_index_of_node_;  // index in the file -> index in the model; kNone: not in the scene
  std::set<int> without_joints_;          // meshes whose vertices have no joints
  GltfDocument document_;
  tinygltf::Model source_;
  Model model_;
};

}  // namespace

Model read_gltf(const std::filesystem::path& file) try { return GltfReader(file).read(); } catch (const GltfError& e) {
  throw GltfError(fmt::format("{}: the model cannot be read, because {}", file.string(), e.what()));
}

}  // namespace gearshift::engine
