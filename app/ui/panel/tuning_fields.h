// The parameters that can be tuned while the loop runs, as the panel uses them.
#pragma once

#include <cstddef>
#include <iterator>
#include <variant>

#include "haptics/loop/haptic_config.h"

namespace gearshift::ui {

using TuningField = haptics::Parameter<haptics::HapticTuning>;
inline constexpr const auto& kTuningFields = haptics::kParameters<haptics::HapticTuning>;

inline double& value_of(haptics::HapticTuning& tuning, const TuningField& field) {
  return tuning.*std::get<double haptics::HapticTuning::*>(field.member);
}
inline double value_of(const haptics::HapticTuning& tuning, const TuningField& field) {
  return tuning.*std::get<double haptics::HapticTuning::*>(field.member);
}

// Index into kTuningFields. parameter: not kHold.
constexpr std::size_t index_of(haptics::TuningParameter parameter) {
  return static_cast<std::size_t>(&haptics::parameter_of(parameter) - kTuningFields);
}

}  // namespace gearshift::ui
