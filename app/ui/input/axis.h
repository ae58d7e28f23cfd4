// Binding of a control (pedal, handbrake or lever) to an axis of a controller.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/window/controllers.h"

namespace gearshift::ui {

// How a bindings file names a controller.
struct ControllerName {
  std::string stick{};  // part of the name, the USB id ("046d:c24f") or the whole GUID; empty: any game pad
  std::string id{};     // USB id, for a controller that appears under another name today; may be empty
  bool operator==(const ControllerName&) const = default;
};

struct AxisBinding {
  ControllerName of{};
  int which = 0;           // index among the controllers of this name, in the order of engine::Controllers
  int axis = 0;            // of any game pad: index in Gamepad::axes; of a named controller: index in Controller::axes
  double from = -1.0;      // raw value of a released pedal, or of a lever at its left or back end
  double to = 1.0;         // raw value of a fully pressed pedal, or of a lever at its right or forward end
  double dead_zone = 0.0;  // [1] 0 to 0.9: fraction ignored around a lever's rest position or at a pedal's start
  double end_zone = 0.0;   // [1] 0 to 0.9: fraction at the end that counts as full; dead_zone + end_zone <= 0.95
  std::optional<double> centre{};  // raw value of a lever at rest, between `from` and `to`; default: midway
  bool operator==(const AxisBinding&) const = default;
};

// True if both bindings use the same part of the same axis. Two pedals may share an axis, each using one half; their
// dead zones may overlap, because the measured rest of one may be a count beyond that of the other.
bool overlap(const AxisBinding& a, const AxisBinding& b);

// Returns a name that finds this controller again and can be written to a file.
ControllerName name_of(const engine::Controller& controller);

// Returns true if the controller's name contains `stick` (ignoring case), or its USB id or GUID equals `stick`. False
// if `stick` is empty.
bool matches_stick(const engine::Controller& controller, std::string_view stick);

double centre_of(const AxisBinding& axis) noexcept;
double lever_value(const AxisBinding& axis, double raw) noexcept;  // -1: left or back, 1: right or forward
double pedal_value(const AxisBinding& axis, double raw) noexcept;  // 0: released, 1: fully pressed

}  // namespace gearshift::ui
