// How much feedback the coach gives.
#pragma once

#include <cstdint>

namespace gearshift::lessons {

// More skill, less feedback: skills learnt with fading feedback are retained better than with feedback on every trial
// (Aoyagi 2019; bandwidth feedback: Schmidt).
enum class HintStyle : std::uint8_t {
  prescriptive,  // hints when a step takes long, and every error
  bandwidth,     // only errors, which are outside the tolerance
  summary        // no feedback on the way, all errors at the end
};

}  // namespace gearshift::lessons
