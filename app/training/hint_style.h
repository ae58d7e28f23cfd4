// How much the coach says.
#pragma once

#include <cstdint>

namespace gearshift {

// As skill grows: feedback that fades by itself keeps better than feedback on every trial (Aoyagi 2019; bandwidth
// feedback: Schmidt).
enum class HintStyle : std::uint8_t {
  prescriptive,  // what to do next, when it takes long, and every fault
  bandwidth,     // only what was outside the tolerance: the faults
  summary        // nothing on the way, all faults at the end
};

}  // namespace gearshift
