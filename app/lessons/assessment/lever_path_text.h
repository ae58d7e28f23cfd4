// Describes the lever's path from gear to gear in words, for any gate.
#pragma once

#include <string>

#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Returns a sentence such as "Straight back." or "Into neutral, to the right against the spring, then forward." `from`:
// current gear, or kNeutralGear. Both gears must exist in the gate.
std::string describe_lever_path(const haptics::Gate& gate, int from, int to);

std::string gear_word(int gear);  // for example "first", "reverse" or "neutral"; "gear 7" above sixth

}  // namespace gearshift::lessons
