#include "engine/render/static_casters.h"

namespace gearshift::engine {

bool StaticCasters::update(const ShadowFit& fit, const FrameScene& scene, std::span<const DrawItem> items) {
  const bool size_changed = nodes_.size() != scene.nodes.size();
  bool stale = size_changed || fit.clip_from_world != clip_from_world_;
  clip_from_world_ = fit.clip_from_world;

  std::vector<Caster> current(scene.nodes.size());
  for (const DrawItem& item : items) {
    Caster& caster = current[item.node];
    caster.casts = caster.casts || !item.blended;
    caster.world = scene.nodes[item.node].world;
    caster.moves = caster.moves || item.deformed;
  }
  for (std::size_t node = 0; node < current.size() && !size_changed; ++node) {
    const Caster& previous = nodes_[node];
    const bool caster_changed =
        current[node].casts != previous.casts || (current[node].casts && current[node].world != previous.world);
    if (caster_changed && !previous.moves) stale = true;
    current[node].moves = current[node].moves || previous.moves || caster_changed;
  }
  nodes_ = std::move(current);
  return stale;
}

}  // namespace gearshift::engine
