// What a person has to know of a stick, and to do with it, in words.
#pragma once

#include <string>

#include "app/panel/panel.h"

namespace gearshift {

// "plugged in, answers after 3.1 ms", "unplugged"
std::string stick_words(const StickView& stick);

// What to do next; empty where there is no stick, or its forces are on.
std::string stick_request(const PanelInput& input);

}  // namespace gearshift
