// Binding of an axis of a stick, pad or pedal.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/window/pads.h"

namespace gearshift::ui {

struct AxisBinding {
  int pad = 0;  // index among the sticks that match `stick`; 0: the one plugged in first
  int axis = 0;
  double from = -1.0;            // raw value of a released pedal, or of a lever at its left or back end
  double to = 1.0;               // raw value of a fully pressed pedal, or of a lever at its right or forward end
  double dead_zone = 0.0;        // [1] 0 to 0.9: ignored range around a lever's rest position or at a pedal's start
  double end_zone = 0.0;         // [1] 0 to 0.9: end of the range that counts as full; dead_zone + end_zone <= 0.95
  std::optional<double> centre;  // raw value of a lever at rest, between `from` and `to`; default: their middle
  std::string stick;             // part of the stick's name, or its whole GUID; empty: any stick
};

// True if the stick's name contains `name` (ignoring case), or its GUID equals it.
bool matches_stick(const engine::PadState& stick, std::string_view name);

// The stick that the axis belongs to; null if it is not plugged in.
const engine::PadState* find_stick(const std::vector<engine::PadState>& sticks, const AxisBinding& axis);

double centre_of(const AxisBinding& axis) noexcept;
double lever_value(const AxisBinding& axis, double raw) noexcept;  // -1 left or back, 1 right or forward
double pedal_value(const AxisBinding& axis, double raw) noexcept;  // 0: released, 1: fully pressed

}  // namespace gearshift::ui
