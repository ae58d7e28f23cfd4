// Synthesises the lever's sounds and its warnings: mono samples from -1 to 1 at kSoundRate, identical in every call.
// Loops repeat without a click.
#pragma once

#include <vector>

namespace gearshift::cabin {

// Sounds that are played once.
std::vector<float> wall_knock();     // the lever hits the gate: steel on steel, damped by the lever
std::vector<float> gear_in_click();  // the detent engages, then the sleeve meets its stop
std::vector<float> gear_out_click();

// Sounds that are played as loops.
std::vector<float> over_push_loop();   // two alternating tones of 0.2 s each, without a pause
std::vector<float> saturation_loop();  // three short beeps at a higher pitch than over-push, then a pause

inline constexpr double kOverPushTones[2] = {1200.0, 1600.0};  // [Hz]
inline constexpr double kSaturationTone = 2500.0;              // [Hz]

}  // namespace gearshift::cabin
