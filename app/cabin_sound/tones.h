// What the cabin's sounds are put together from.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace gearshift {

std::size_t samples_in(double seconds) noexcept;  // at kSoundRate
double seconds_at(std::size_t sample) noexcept;

// A damped sine.
struct Mode {
  double frequency;  // [Hz]
  double decay;      // [s] to 1/e
  double amplitude;
};

// Added from `start` [s] to the end of `out`. Sines begin at 0, so that a strike has no step.
void strike(std::vector<float>& out, double start, double strength, std::initializer_list<Mode> modes);

// Added; within `out`. 5 ms of raised cosine at each end; a second harmonic makes it easier to tell where it comes
// from. [s], [s], [Hz]
void tone(std::vector<float>& out, double start, double length, double frequency);

void fade_out(std::vector<float>& out, double seconds);  // the last of it, straight to 0
void normalise(std::vector<float>& out, float peak);     // to that largest magnitude; not of silence alone

}  // namespace gearshift
