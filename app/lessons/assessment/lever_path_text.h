// Describes the lever's path from gear to gear in words, for any gate.
#pragma once

#include <string>

#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// For example "Straight back." or "Into neutral, to the right against the spring, then forward." from: kNeutralGear for
// a lever at rest in the aisle. Both gears must be in the gate.
std::string describe_lever_path(const haptics::Gate& gate, int from, int to);

std::string gear_word(int gear);  // "first", "reverse", "neutral"; "gear 7" above sixth

}  // namespace gearshift::lessons
