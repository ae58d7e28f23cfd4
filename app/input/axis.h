// What an axis of a stick, a pad or a pedal means.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/window/sticks.h"

namespace gearshift {

struct AxisBinding {
  int pad = 0;  // of the sticks that are meant, 0: the first one plugged in
  int axis = 0;
  double from = -1.0;            // raw value that means 0 ...
  double to = 1.0;               // ... and 1 (pedals), or -1 and 1 (lever)
  double dead_zone = 0.0;        // [1] 0 to 0.9, around a lever's rest, or at a pedal's start
  double end_zone = 0.0;         // [1] 0 to 0.9, before the end, which is reached there; at most 0.95 with dead_zone
  std::optional<double> centre;  // raw value of a lever at rest, between the two; the middle of them where not said
  std::string stick;             // a part of the stick's name, or its whole GUID; empty: any stick
};

// Is it called that, or a part of that, whatever the case; or is that its GUID?
bool is_meant(const PadState& stick, std::string_view name);

// The stick of that axis; null where it is not plugged in.
const PadState* find_stick(const std::vector<PadState>& sticks, const AxisBinding& axis);

double centre_of(const AxisBinding& axis) noexcept;
double lever_value(const AxisBinding& axis, double raw) noexcept;  // -1 left or back, 1 right or forward
double pedal_value(const AxisBinding& axis, double raw) noexcept;  // 0 up, 1 down

}  // namespace gearshift
