#include "engine/render/still_casters.h"

namespace gearshift {

bool StillCasters::changed(const ShadowFit& fit, const FrameScene& scene, std::span<const DrawItem> items) {
  const bool fresh = nodes_.size() != scene.nodes.size();
  bool anew = fresh || fit.clip_from_world != clip_from_world_;
  clip_from_world_ = fit.clip_from_world;

  std::vector<Caster> now(scene.nodes.size());
  for (const DrawItem& item : items) {
    Caster& caster = now[item.node];
    caster.casts = caster.casts || !item.blended;
    caster.world = scene.nodes[item.node].world;
    caster.moves = caster.moves || item.deformed;
  }
  for (std::size_t node = 0; node < now.size() && !fresh; ++node) {
    const Caster& before = nodes_[node];
    const bool other = now[node].casts != before.casts || (now[node].casts && now[node].world != before.world);
    if (other && !before.moves) anew = true;
    now[node].moves = now[node].moves || before.moves || other;
  }
  nodes_ = std::move(now);
  return anew;
}

}  // namespace gearshift
