// How much feedback the coach gives.
#pragma once

#include <cstdint>

namespace gearshift::lessons {

// Feedback is reduced as skill grows: skills learnt with fading feedback are retained better than skills learnt with
// feedback on every trial (Aoyagi 2019; bandwidth feedback: Schmidt).
enum class HintStyle : std::uint8_t {
  prescriptive,  // shows hints when a step takes long, and every error
  bandwidth,     // shows only errors: actions outside the tolerance
  summary        // shows all errors at the end, nothing during the drive
};

}  // namespace gearshift::lessons
