// Which casters stand still: their shadow is drawn once and kept.
#pragma once

#include <vector>

#include "engine/render/draw_list.h"
#include "engine/render/shadow_fit.h"

namespace gearshift {

class StillCasters {
 public:
  // True where the kept map no longer shows the casters that stand still: the sun or the fit changed, or one of them
  // moved, came or went. A node that has once moved counts as moving from then on.
  bool changed(const ShadowFit& fit, const FrameScene& scene, std::span<const DrawItem> items);
  bool stands_still(std::uint32_t node) const { return !nodes_[node].moves; }
  void forget() { *this = {}; }  // another model or map

 private:
  struct Caster {
    glm::mat4 world{1.0f};
    bool casts = false;
    bool moves = false;
  };
  std::vector<Caster> nodes_;
  glm::mat4 clip_from_world_{0.0f};
};

}  // namespace gearshift
