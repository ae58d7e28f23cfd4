// The help window: the bindings, and the panel's own keys.
#pragma once

#include <string>

namespace gearshift::ui {

// Sets `open` to false when the user closes the window. `bindings`: one binding per line, with a tab between key and
// action.
void draw_help(bool& open, const std::string& bindings);

}  // namespace gearshift::ui
