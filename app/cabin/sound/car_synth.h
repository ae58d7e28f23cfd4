// Synthesises the driveline's sounds: mono samples from -1 to 1 at kSoundRate, identical in every call. Each loop is
// made for one speed; a change of pitch adapts it to other speeds.
#pragma once

#include <vector>

namespace gearshift::cabin {

// Dog teeth that rattle past each other: noise in bursts, kGrindLoopRate times per second.
inline constexpr double kGrindLoopRate = 150.0;  // [Hz]
std::vector<float> grind_loop();

// The starter motor at the engine speed kStarterLoopSpeed: its pinion whines on a ring gear with kRingTeeth teeth, and
// each compression of the four cylinders slows the motor down and thumps.
inline constexpr double kStarterLoopSpeed = 240.0;  // [1/min]
inline constexpr double kRingTeeth = 130.0;         // [1]
std::vector<float> starter_loop();

// Body panels that drone at the frequency kJudderTone with every firing of four cylinders, at the engine speed
// kJudderLoopSpeed.
inline constexpr double kJudderLoopSpeed = 400.0;  // [1/min]
inline constexpr double kJudderTone = 60.0;        // [Hz]
std::vector<float> judder_loop();

// Unburnt fuel that pops in the exhaust while the rev limiter cuts the fuel.
inline constexpr double kLimiterRate = 12.0;  // [Hz] pops per second
std::vector<float> limiter_loop();

// The over-rev warning: a tone that sounds 4 times per second, with pauses as long as the tone.
inline constexpr double kOverRevTone = 900.0;  // [Hz]
inline constexpr double kOverRevRate = 4.0;    // [Hz]
std::vector<float> over_rev_loop();

// The chime for a stalled engine, played once: two bells, the second one lower.
inline constexpr double kStallTones[2] = {1046.5, 698.5};  // [Hz]
std::vector<float> stall_chime();

inline constexpr double kBiteTone = 1760.0;  // [Hz] of the tick at the clutch's bite point, a wooden block
std::vector<float> bite_tick();

}  // namespace gearshift::cabin
