#include "engine/render/draw_list.h"

#include <algorithm>
#include <tuple>

#include <glm/geometric.hpp>

#include "shaders/shared.h"

namespace gearshift::engine {

namespace {

const DeformedRange* find_range(std::span<const DeformedRange> deformed, int mesh, int node) {
  const auto found = std::find_if(deformed.begin(), deformed.end(),
                                  [&](const auto& d) { return d.mesh == mesh && (d.node == node || d.node == kNone); });
  return found == deformed.end() ? nullptr : &*found;
}

float distance(const DrawItem& item, glm::vec3 eye) {
  return glm::distance(item.box.centre(), eye);
}

// Each combination of features is a separate shader, which a software driver compiles slowly on first use. The mirror
// is small, so it uses few combinations: all materials sample the maps of base colour and occlusion, and no other map.
// A material that lacks one of these maps has a white texture bound in its place.
std::uint32_t mirror_features(std::uint32_t features) {
  using namespace shader;
  constexpr std::uint32_t kPreservedFeatures =
      kIndoors | kMasked | kBlended | kVertexColour | kTransformedUv | kMapOnUv1 << kMapBaseColour;
  constexpr std::uint32_t kForcedFeatures =
      kHasMap << kMapBaseColour | kHasMap << kMapOcclusion | kMapOnUv1 << kMapOcclusion;
  const bool occluded_by_uv0 =
      (features & kHasMap << kMapOcclusion) != 0 && (features & kMapOnUv1 << kMapOcclusion) == 0;
  const std::uint32_t all = (features & kPreservedFeatures) | kForcedFeatures | kEmits | kLinearOut;
  return occluded_by_uv0 ? all & ~(kMapOnUv1 << kMapOcclusion) : all;
}

}  // namespace

std::vector<DrawItem> list_items(const GpuModel& model, const FrameScene& scene,
                                 std::span<const DeformedRange> deformed) {
  std::vector<DrawItem> items;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    const NodeState& state = scene.nodes[node];
    const int mesh_index = model.mesh_of_node[node];
    if (mesh_index == kNone || !state.visible || state.opacity <= 0.0f) continue;
    const GpuMesh& mesh = model.meshes[static_cast<std::size_t>(mesh_index)];
    const DeformedRange* range = find_range(deformed, mesh_index, static_cast<int>(node));
    for (std::uint32_t i = 0; i < mesh.part_count; ++i) {
      DrawItem item;
      item.part = &model.parts[mesh.first_part + i];
      item.material = &model.materials[item.part->material];
      item.node = static_cast<std::uint32_t>(node);
      item.box = transformed(state.world, range != nullptr ? range->box : item.part->box);
      item.deformed = range != nullptr;
      if (item.deformed)
        item.vertex_offset =
            static_cast<std::int32_t>(range->first_vertex) - static_cast<std::int32_t>(mesh.first_vertex);
      item.mirrored = glm::determinant(glm::mat3(state.world)) < 0.0f;
      item.blended = item.material->blended || state.opacity < 1.0f;
      item.indoors = state.indoors;
      item.emission = state.emissive;
      item.opacity = state.opacity;
      items.push_back(item);
    }
  }
  return items;
}

DrawList list_draws(std::span<const DrawItem> items, const Frusta& frusta, glm::vec3 eye) {
  DrawList list;
  for (const DrawItem& item : items) {
    if (frusta.intersects(item.box)) (item.blended ? list.blended : list.solid).push_back(&item);
  }
  const auto solid_key = [&](const DrawItem* item) {
    return std::tuple(item->material->features, item->part->material, distance(*item, eye), item->part);
  };
  std::sort(list.solid.begin(), list.solid.end(), [&](auto a, auto b) { return solid_key(a) < solid_key(b); });
  std::stable_sort(list.blended.begin(), list.blended.end(),
                   [&](auto a, auto b) { return distance(*a, eye) > distance(*b, eye); });
  return list;
}

std::uint32_t features_in(PassKind pass, const DrawItem& item, const FeatureChoice& choice) {
  using namespace shader;
  std::uint32_t features = item.material->features;
  if (pass == PassKind::shadow || pass == PassKind::depth) {
    constexpr std::uint32_t kAlphaTestFeatures =
        kMasked | kVertexColour | kHasMap << kMapBaseColour | kMapOnUv1 << kMapBaseColour;
    return (features & kMasked) != 0 ? features & kAlphaTestFeatures : 0u;
  }
  if (item.blended) features |= kBlended;
  if (item.indoors) features |= kIndoors;
  if (pass == PassKind::mirror) return mirror_features(features);
  if (!choice.normal_maps) features &= ~(kHasMap << kMapNormal);
  if ((features & kAllMaps) == 0) features |= kEmits;  // materials without maps share one shader, emissive or not
  if (item.shows_mirror) return features | kShowsMirror;
  return choice.shadow ? features | kShadowed : features;
}

}  // namespace gearshift::engine
