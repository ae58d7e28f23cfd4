#include "engine/render/static_casters.h"

namespace gearshift::engine {

bool StaticCasters::update(const ShadowFit& fit, const FrameScene& scene, std::span<const DrawItem> items) {
  const bool size_changed = nodes_.size() != scene.nodes.size();
  bool stale = size_changed || fit.clip_from_world != clip_from_world_;
  clip_from_world_ = fit.clip_from_world;

  std::vector<Caster> now(scene.nodes.size());
  for (const DrawItem& item : items) {
    Caster& caster = now[item.node];
    caster.casts = caster.casts || !item.blended;
    caster.world = scene.nodes[item.node].world;
    caster.moves = caster.moves || item.deformed;
  }
  for (std::size_t node = 0; node < now.size() && !size_changed; ++node) {
    const Caster& before = nodes_[node];
    const bool caster_changed = now[node].casts != before.casts || (now[node].casts && now[node].world != before.world);
    if (caster_changed && !before.moves) stale = true;
    now[node].moves = now[node].moves || before.moves || caster_changed;
  }
  nodes_ = std::move(now);
  return stale;
}

}  // namespace gearshift::engine
