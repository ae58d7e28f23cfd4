// Simulates a lever at rest in a wall through the complete shipped cycle and measures how a small disturbance grows.
#pragma once

#include "haptics/analysis/sampled_loop.h"

namespace gearshift::lab {

// Simulates what spectral_radius() predicts: growth of a disturbance per cycle [1], without quantisation and
// saturation. `settle`: stiffness of a softer, stable wall in which the lever first settles [N/m]. Throws
// std::invalid_argument if the loop rejects the values.
double simulated_growth(const haptics::AxisModel& handle, const haptics::HandImpedance& hand,
                        const haptics::ContactLaw& law, double period, double settle);

// Simulates what stiffness_limit() predicts: the stiffness [N/m] at which a disturbance starts to grow, within 0.1 %.
// The search starts at `guess`.
double simulated_limit(const haptics::AxisModel& handle, const haptics::HandImpedance& hand, haptics::ContactLaw law,
                       double period, double guess);

}  // namespace gearshift::lab
