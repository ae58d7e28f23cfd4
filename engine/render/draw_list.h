// Lists what a frame draws, and in which order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/render/gpu_model.h"
#include "engine/render/pipelines.h"
#include "engine/scene/frame_scene.h"

namespace gearshift::engine {

// A mesh that is deformed in this frame: its vertices are in the frame slot's vertex buffer.
struct DeformedRange {
  int mesh = kNone;
  int node = kNone;                // kNone: all nodes that carry the mesh
  std::uint32_t first_vertex = 0;  // index in the frame slot's vertex buffer
  Box box;
};

struct DrawItem {
  const Part* part = nullptr;
  const GpuMaterial* material = nullptr;
  std::uint32_t node = 0;
  Box box;  // [m] world
  std::int32_t vertex_offset = 0;
  bool deformed = false;  // vertices are in the frame slot's vertex buffer
  bool mirrored = false;  // the node's transform turns the triangles inside out
  bool blended = false;
  bool indoors = false;
  bool shows_mirror = false;  // shows this frame's mirror picture, in the main pass
  float emission = 1.0f, opacity = 1.0f;
};

// Lists every part of every visible node.
std::vector<DrawItem> list_items(const GpuModel& model, const FrameScene& scene,
                                 std::span<const DeformedRange> deformed);

struct DrawList {
  std::vector<const DrawItem*> solid;    // sorted by pipeline and material, then front to back
  std::vector<const DrawItem*> blended;  // back to front
};
DrawList list_draws(std::span<const DrawItem> items, const Frusta& frusta, glm::vec3 eye);

// Optional features that the renderer has turned on.
struct FeatureChoice {
  bool shadow = true, normal_maps = true;
};
std::uint32_t features_in(PassKind pass, const DrawItem& item, const FeatureChoice& choice);

}  // namespace gearshift::engine
