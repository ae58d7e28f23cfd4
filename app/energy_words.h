// How a wall's energy is kept in bounds, in words.
#pragma once

#include "haptics/safety/energy_control.h"

namespace gearshift {

const char* energy_words(EnergyControl control) noexcept;  // "energy bounding"

}  // namespace gearshift
