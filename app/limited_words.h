// What a device did not admit as wanted, in words.
#pragma once

#include <string>

#include "haptics/loop/haptic_config.h"

namespace gearshift {

// "wall_stiffness_n_per_m limited from 5000 to 301 (law; hand: bare)"; in a study "... used all the same, the bound
// is"; "hold limited from observer to half_sample".
std::string limited_words(const Limited& limited);

}  // namespace gearshift
