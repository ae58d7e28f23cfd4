// Synthesises the engine as loops. All are made for one speed, kEngineLoopSpeed, so that all play at one pitch and stay
// in phase: partials of the same order then add in amplitude, and a mix of loops is a spectrum between theirs, without
// beats. The loops differ in the timbre that the engine has at the speed of each band.
#pragma once

#include <array>
#include <vector>

namespace gearshift::cabin {

inline constexpr double kEngineLoopSpeed = 2400.0;                                      // [1/min]
inline constexpr std::array<double, 4> kEngineBands = {900.0, 1800.0, 3400.0, 6000.0};  // [1/min]

enum class EngineLoad { coasting, full };

// One loop: a whole number of engine cycles (two revolutions) at kEngineLoopSpeed, with the engine's timbre at
// kEngineBands[band]. cylinders 1 to 12, four-stroke: the strongest partial is the firing frequency, speed / 60 *
// cylinders / 2. Every partial is at least as strong at full load as when coasting.
std::vector<float> engine_loop(int cylinders, std::size_t band, EngineLoad load);

// Weight of each band's loop at a speed [1/min]: the two nearest bands are blended by the logarithm of the speed; the
// sum is 1.
std::array<double, kEngineBands.size()> band_weights(double speed);

}  // namespace gearshift::cabin
