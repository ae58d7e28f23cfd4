// Sounds of the driveline, made from formulas: mono samples in [-1, 1] at kSoundRate, the same at every call. Each loop
// is made at one speed and played at the pitch of another.
#pragma once

#include <vector>

namespace gearshift {

// Dogs that pass each other: noise of their ringing, let through kGrindLoopRate times a second.
inline constexpr double kGrindLoopRate = 150.0;  // [Hz]
std::vector<float> grind_loop();

// The starter at kStarterLoopSpeed of the engine: its pinion whines on a ring of kRingTeeth, and each of four
// cylinders' compressions holds it up and thumps.
inline constexpr double kStarterLoopSpeed = 240.0;  // [1/min]
inline constexpr double kRingTeeth = 130.0;         // [1]
std::vector<float> starter_loop();

// Panels that drone at kJudderTone with every firing of four cylinders at kJudderLoopSpeed.
inline constexpr double kJudderLoopSpeed = 400.0;  // [1/min]
inline constexpr double kJudderTone = 60.0;        // [Hz]
std::vector<float> judder_loop();

// Unburnt fuel that pops in the exhaust while the limiter cuts.
inline constexpr double kLimiterRate = 12.0;  // [Hz]
std::vector<float> limiter_loop();

// Beyond the red line: one tone, 4 times a second, as long as the pause after it.
inline constexpr double kOverRevTone = 900.0;  // [Hz]
inline constexpr double kOverRevRate = 4.0;    // [Hz]
std::vector<float> over_rev_loop();

// Struck once when the engine has died: two bells, the second lower.
inline constexpr double kStallTones[2] = {1046.5, 698.5};  // [Hz]
std::vector<float> stall_chime();

}  // namespace gearshift
