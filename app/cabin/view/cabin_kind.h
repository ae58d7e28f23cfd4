// How much of the lever mechanism is visible in the cabin.
#pragma once

#include <string_view>

#include "app/cabin/stage/stage.h"

namespace gearshift::cabin {

// closed: boot and hand; open_gate: slotted plate without them; cutaway: also the cut-away gearbox beside it.
enum class Cabin { closed, open_gate, cutaway };

Cabin cabin_for_camera(std::string_view camera);  // see camera()
StageConfig stage_config(const haptics::Gate& gate, const haptics::YokeGeometry& yoke, Cabin cabin);

}  // namespace gearshift::cabin
