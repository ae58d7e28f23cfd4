// Binding of a control (pedal or lever) to an axis of a stick, pad or pedal set.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/window/pads.h"

namespace gearshift::ui {

struct AxisBinding {
  int pad = 0;  // index among the sticks that match `stick`; 0: the first one plugged in
  int axis = 0;
  double from = -1.0;            // raw value of a released pedal, or of a lever at its left or back end
  double to = 1.0;               // raw value of a fully pressed pedal, or of a lever at its right or forward end
  double dead_zone = 0.0;        // [1] 0 to 0.9: fraction ignored around a lever's rest position or at a pedal's start
  double end_zone = 0.0;         // [1] 0 to 0.9: fraction at the end that counts as full; dead_zone + end_zone <= 0.95
  std::optional<double> centre;  // raw value of a lever at rest, between `from` and `to`; default: midway
  std::string stick;             // part of the stick's name, or its whole GUID; empty: any game pad
};

// Returns true if the stick's name contains `name` (ignoring case) or its GUID equals `name`. An empty name stands for
// any game pad, because axes of other sticks mean nothing before a person has said which is which.
bool matches_stick(const engine::PadState& stick, std::string_view name);

// Returns the stick that the axis belongs to; null if this stick is not plugged in.
const engine::PadState* find_stick(const std::vector<engine::PadState>& sticks, const AxisBinding& axis);

double centre_of(const AxisBinding& axis) noexcept;
double lever_value(const AxisBinding& axis, double raw) noexcept;  // -1: left or back, 1: right or forward
double pedal_value(const AxisBinding& axis, double raw) noexcept;  // 0: released, 1: fully pressed

}  // namespace gearshift::ui
