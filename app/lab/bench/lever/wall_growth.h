// Simulates a small disturbance of a lever at rest in a wall through the whole shipped cycle and measures its growth.
#pragma once

#include "haptics/analysis/sampled_loop.h"

namespace gearshift::lab {

// Simulated counterpart of spectral_radius(): growth of the disturbance per cycle [1], without quantisation and
// saturation. settle: stiffness of a softer, stable wall on which the lever settles first [N/m]. Throws
// std::invalid_argument if the loop rejects the values.
double simulated_growth(const haptics::AxisModel& handle, const haptics::HandImpedance& hand,
                        const haptics::ContactLaw& law, double period, double settle);

// Simulated counterpart of stiffness_limit(): the stiffness near `guess` at which the disturbance starts to grow,
// within 0.1 %. [N/m]
double simulated_limit(const haptics::AxisModel& handle, const haptics::HandImpedance& hand, haptics::ContactLaw law,
                       double period, double guess);

}  // namespace gearshift::lab
