// How much feedback the coach gives.
#pragma once

#include <cstdint>

namespace gearshift::lessons {

// Feedback is reduced as skill grows. Skills learnt with fading feedback are retained better than skills learnt with
// feedback on every trial (Aoyagi 2019; Schmidt for bandwidth feedback).
enum class HintStyle : std::uint8_t {
  prescriptive,  // shows every error, and a hint when a step takes long
  bandwidth,     // shows errors, but no hints
  summary        // shows all errors at the end and nothing during the drive
};

}  // namespace gearshift::lessons
