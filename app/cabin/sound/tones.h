// Building blocks of the cabin's sounds.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace gearshift::cabin {

std::size_t samples_in(double seconds) noexcept;  // number of samples at kSoundRate
double seconds_at(std::size_t sample) noexcept;

// A damped sine.
struct Mode {
  double frequency;  // [Hz]
  double decay;      // [s] until the amplitude has fallen to 1/e
  double amplitude;
};

// Adds a strike from `start` [s] to the end of `out`. Its sines begin at 0, so that the signal has no step.
void strike(std::vector<float>& out, double start, double strength, std::initializer_list<Mode> modes);

// Adds a tone to `out`, with a raised cosine of 5 ms at each end and a second harmonic that makes the tone easier to
// localise. start [s], length [s], frequency [Hz].
void tone(std::vector<float>& out, double start, double length, double frequency);

void fade_out(std::vector<float>& out, double seconds);  // fades the end linearly to 0
void normalise(std::vector<float>& out, float peak);     // scales to this peak magnitude; `out` must not be silent

}  // namespace gearshift::cabin
