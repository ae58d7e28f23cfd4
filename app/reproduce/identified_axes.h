// Section 2.4 on the study's own device: both axes swept and fitted.
#pragma once

#include <array>

#include "app/reproduce/section.h"
#include "haptics/analysis/identification.h"

namespace gearshift {

inline constexpr double kPaperHighest = 65.0;  // [Hz] where the paper stopped

struct IdentifiedAxis {
  FrequencyResponse response;
  AxisFit fit;
};

// The preset's lever without a hand, at the preset's rate. literal: the paper's amplitude whatever the stroke.
FrequencyResponse sweep_axis(const Study& study, LeverAxis axis, bool literal);

std::array<IdentifiedAxis, 2> identify_axes(const Study& study);  // X, Y

}  // namespace gearshift
