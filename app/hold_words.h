// What is made of a sampled depth, by name.
#pragma once

#include "haptics/contact/virtual_coupling.h"

namespace gearshift {

const char* hold_name(ContactHold hold) noexcept;   // "half_sample", as files and command lines have it
const char* hold_words(ContactHold hold) noexcept;  // "half-sample hold"

}  // namespace gearshift
