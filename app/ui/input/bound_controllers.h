// Finds the controllers to which bindings apply, and says which of them are missing or changed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/ui/input/bindings.h"

namespace gearshift::ui {

// Returns the game pads to which the bindings of any game pad apply: those that the bindings do not name.
std::vector<const engine::Controller*> free_gamepads(const Bindings& bindings,
                                                     const std::vector<engine::Controller>& all);

// Returns the raw value of the axis; empty if its controller is not plugged in or has no such axis.
std::optional<double> raw_value(const Bindings& bindings, const AxisBinding& axis,
                                const std::vector<engine::Controller>& all);

// Returns the controllers that move nothing until the user sets them up: neither game pads nor named by the bindings.
std::vector<const engine::Controller*> unbound_controllers(const Bindings& bindings,
                                                           const std::vector<engine::Controller>& all);

// Sentences about controllers that the bindings name but that are absent, have another name today, may not be read, or
// have too few buttons; and about controllers that move nothing yet.
std::vector<std::string> describe_controllers(const Bindings& bindings, const std::vector<engine::Controller>& all);

}  // namespace gearshift::ui
