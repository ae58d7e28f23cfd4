// Finds the controllers to which bindings apply, and says which of them are missing or changed.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/ui/input/bindings.h"

namespace gearshift::ui {

// True if the controller surely is a game pad. GLFW also takes some encoder boards for one that people build into
// shifters, hand brakes and button boxes.
bool is_game_pad(const engine::Controller& controller) noexcept;

// Returns the game pads to which the bindings of any game pad apply: those that the bindings do not name.
std::vector<const engine::Controller*> free_gamepads(const Bindings& bindings,
                                                     const std::vector<engine::Controller>& all);

// Returns the controllers of this name: those whose name, USB id or GUID is exactly this; else those whose name contains
// it; else, if it appears under another name today, the only one with its USB id. Another name of the bindings that fits
// a controller exactly, or that fits at all in the last case, keeps it.
std::vector<const engine::Controller*> find_controllers(const Bindings& bindings, const ControllerName& name,
                                                        const std::vector<engine::Controller>& all);

// Returns the n-th of them; null if it is not plugged in.
const engine::Controller* find_controller(const Bindings& bindings, const ControllerName& name, int which,
                                          const std::vector<engine::Controller>& all);

// Returns the raw value of the axis; empty if its controller is not plugged in or has no such axis.
std::optional<double> raw_value(const Bindings& bindings, const AxisBinding& axis,
                                const std::vector<engine::Controller>& all);

// Returns the controllers that move nothing until the user sets them up: neither game pads nor named by the bindings.
std::vector<const engine::Controller*> unbound_controllers(const Bindings& bindings,
                                                           const std::vector<engine::Controller>& all);

// Sentences about controllers that the bindings name but that are absent, have another name today, may not be read, or
// have too few buttons.
std::vector<std::string> describe_bound(const Bindings& bindings, const std::vector<engine::Controller>& all);
// Sentences about controllers that have no effect yet. `declined`: names of those that the user does not want to set up.
std::vector<std::string> describe_unbound(const Bindings& bindings, const std::vector<engine::Controller>& all,
                                          const std::set<std::string>& declined = {});

}  // namespace gearshift::ui
