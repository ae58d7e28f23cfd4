// Synthesises the engine's sound as loops. All loops are made for the same speed, kEngineLoopSpeed, so that they play
// at the same pitch and stay in phase. Partials of the same order then add in amplitude, and a mix of two loops has a
// spectrum between theirs, without beats. The loops differ in timbre: each has the timbre of the engine at the speed of
// its band.
#pragma once

#include <array>
#include <vector>

namespace gearshift::cabin {

inline constexpr double kEngineLoopSpeed = 2400.0;                                      // [1/min]
inline constexpr std::array<double, 4> kEngineBands = {900.0, 1800.0, 3400.0, 6000.0};  // [1/min]

enum class EngineLoad { coasting, full };

// One loop: a whole number of engine cycles (two revolutions each) at kEngineLoopSpeed, with the engine's timbre at
// kEngineBands[band]. `cylinders`: 1 to 12, four-stroke. The strongest partial is the firing frequency in Hz: (speed /
// 60) * (cylinders / 2), speed in 1/min. Every partial is at least as strong at full load as when coasting.
std::vector<float> engine_loop(int cylinders, std::size_t band, EngineLoad load);

// Weight of each band's loop at an engine speed [1/min]. The two nearest bands are blended by the logarithm of the
// speed. The sum of the weights is 1.
std::array<double, kEngineBands.size()> band_weights(double speed);

}  // namespace gearshift::cabin
