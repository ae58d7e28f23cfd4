// How much of the lever mechanism is visible in the cabin.
#pragma once

#include <string_view>

#include "app/cabin/stage/stage.h"

namespace gearshift::cabin {

// `closed`: boot and hand. `open_gate`: a slotted plate instead of boot and hand. `cutaway`: like `open_gate`, plus the
// cut-away gearbox.
enum class Cabin { closed, open_gate, cutaway };

Cabin cabin_for_camera(std::string_view camera);  // see camera()
StageConfig stage_config(const haptics::Gate& gate, const haptics::YokeGeometry& yoke, Cabin cabin);

}  // namespace gearshift::cabin
