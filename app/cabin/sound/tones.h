// Building blocks of the cabin's sounds.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace gearshift::cabin {

std::size_t samples_in(double seconds) noexcept;  // rounded to samples at kSoundRate
double seconds_at(std::size_t sample) noexcept;

// A damped sine.
struct Mode {
  double frequency;  // [Hz]
  double decay;      // [s] time until the amplitude has fallen to 1/e
  double amplitude;
};

// Adds a strike to `out`, from `start` [s] to the end. Its sines begin at 0, so that the signal has no step.
void strike(std::vector<float>& out, double start, double strength, std::initializer_list<Mode> modes);

// Adds a tone to `out`. The tone fades in and out with a raised cosine of 5 ms. Its second harmonic makes it easier to
// localise. `start` and `length`: [s]. `frequency`: [Hz].
void tone(std::vector<float>& out, double start, double length, double frequency);

void fade_out(std::vector<float>& out, double seconds);  // fades the end linearly to 0
void normalise(std::vector<float>& out, float peak);     // scales the largest magnitude, which must be > 0, to `peak`

}  // namespace gearshift::cabin
