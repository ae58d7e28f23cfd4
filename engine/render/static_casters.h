// Tracks which casters are static: their shadow is drawn once and reused.
#pragma once

#include <vector>

#include "engine/render/draw_list.h"
#include "engine/render/shadow_fit.h"

namespace gearshift::engine {

class StaticCasters {
 public:
  // Call once per frame. Returns true if the static map must be redrawn: the sun or the fit changed, or a static caster
  // moved, appeared or disappeared. A node that has moved once counts as moving from then on.
  bool update(const ShadowFit& fit, const FrameScene& scene, std::span<const DrawItem> items);
  bool is_static(std::uint32_t node) const { return !nodes_[node].moves; }
  void reset() { *this = {}; }  // call after a change of model or map

 private:
  struct Caster {
    glm::mat4 world{1.0f};
    bool casts = false;
    bool moves = false;
  };
  std::vector<Caster> nodes_;
  glm::mat4 clip_from_world_{0.0f};
};

}  // namespace gearshift::engine
