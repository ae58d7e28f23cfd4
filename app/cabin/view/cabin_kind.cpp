#include "app/cabin/view/cabin_kind.h"

namespace gearshift::cabin {

Cabin cabin_for_camera(std::string_view camera) {
  if (camera == "gate") return Cabin::open_gate;
  return camera == "gearbox" ? Cabin::cutaway : Cabin::closed;
}

StageConfig stage_config(const haptics::Gate& gate, const haptics::YokeGeometry& yoke, Cabin cabin) {
  StageConfig config;
  config.gate = gate;
  config.yoke = yoke;
  config.open_gate = cabin != Cabin::closed;
  config.hand = cabin == Cabin::closed;
  config.cutaway = cabin == Cabin::cutaway;
  return config;
}

}  // namespace gearshift::cabin
