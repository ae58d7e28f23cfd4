// A small disturbance of a lever that rests in a wall, followed through the whole shipped cycle: does it grow?
#pragma once

#include "haptics/analysis/sampled_loop.h"

namespace gearshift {

// What spectral_radius() answers, asked of the simulation: by how much the disturbance grows per cycle. [1]
// settle: a softer wall that is stable, on which it rests first [N/m]. No quantisation, no saturation. Throws std::invalid_argument where the loop refuses the numbers.
double simulated_growth(const AxisModel& handle, const HandImpedance& hand, const ContactLaw& law, double period,
                        double settle);

// What stiffness_limit() answers: the stiffness near `guess` at which it begins to grow, within 0.1 %. [N/m]
double simulated_limit(const AxisModel& handle, const HandImpedance& hand, ContactLaw law, double period, double guess);

}  // namespace gearshift
