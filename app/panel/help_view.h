// The bindings, and how the panel is worked by keys.
#pragma once

#include <string>

namespace gearshift {

// open: becomes false where it was closed. One binding per line, key and what it does apart by a tab.
void draw_help(bool& open, const std::string& bindings);

}  // namespace gearshift
