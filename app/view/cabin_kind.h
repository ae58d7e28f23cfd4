// How far the cabin is laid open for what is looked at.
#pragma once

#include <string_view>

#include "app/stage/stage.h"

namespace gearshift {

// With boot and hand; the slotted plate without them; the gearbox laid open beside it.
enum class Cabin { closed, open_gate, cutaway };

Cabin cabin_seen_from(std::string_view camera);  // see camera()
StageConfig stage_config(const Gate& gate, const YokeGeometry& yoke, Cabin cabin);

}  // namespace gearshift
