// Sound measurements for tests: level, spectrum, pitch.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "engine/sound/sound_world.h"

namespace gearshift::test {

// Renders `seconds` of sound in pieces of 1/60 s, like a program that draws at 60 Hz.
inline std::vector<float> listen(engine::SoundWorld& world, double seconds) {
  constexpr std::size_t kFrame = 2 * engine::kSoundRate / 60;
  std::vector<float> stereo(static_cast<std::size_t>(std::lround(seconds * 60.0)) * kFrame);
  for (std::size_t n = 0; n < stereo.size(); n += kFrame) world.render(std::span(stereo).subspan(n, kFrame));
  return stereo;
}

enum class Ear { left, right };

inline std::vector<double> channel(std::span<const float> stereo, Ear ear) {
  std::vector<double> out(stereo.size() / 2);
  for (std::size_t n = 0; n < out.size(); ++n) out[n] = stereo[2 * n + static_cast<std::size_t>(ear)];
  return out;
}

inline std::vector<double> doubles(std::span<const float> samples) {
  return {samples.begin(), samples.end()};
}

inline double rms(std::span<const double> x) {
  double sum = 0.0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

inline double peak(std::span<const double> x) {
  double highest = 0.0;
  for (const double v : x) highest = std::max(highest, std::abs(v));
  return highest;
}

inline double decibels(double ratio) {
  return 20.0 * std::log10(ratio);
}

// Radix-2 FFT in place; the size must be a power of two.
inline void fourier(std::vector<std::complex<double>>& x) {
  const std::size_t size = x.size();
  for (std::size_t i = 1, j = 0; i < size; ++i) {
    std::size_t bit = size >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (std::size_t half = 1; half < size; half *= 2) {
    const std::complex<double> step = std::polar(1.0, -std::numbers::pi / static_cast<double>(half));
    for (std::size_t start = 0; start < size; start += 2 * half) {
      std::complex<double> turn = 1.0;
      for (std::size_t n = start; n < start + half; ++n, turn *= step) {
        const std::complex<double> odd = turn * x[n + half];
        x[n + half] = x[n] - odd;
        x[n] += odd;
      }
    }
  }
}

// Power spectrum with a Hann window, zero-padded; power[n] is at n * hertz_per_bin.
struct Spectrum {
  std::vector<double> power;
  double hertz_per_bin = 0.0;
};

inline Spectrum spectrum(std::span<const double> x) {
  std::size_t size = 1;
  while (size < x.size()) size *= 2;
  std::vector<std::complex<double>> bins(size);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double turn = (static_cast<double>(n) + 0.5) / static_cast<double>(x.size());
    bins[n] = x[n] * (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turn));
  }
  fourier(bins);
  Spectrum out;
  out.hertz_per_bin = static_cast<double>(engine::kSoundRate) / static_cast<double>(size);
  for (std::size_t n = 0; n < size / 2; ++n) out.power.push_back(std::norm(bins[n]));
  return out;
}

// Frequency [Hz] of the strongest line above 5 Hz, interpolated between bins by a parabola through the logarithms.
inline double strongest_line(std::span<const double> x) {
  const auto [power, hertz] = spectrum(x);
  const auto lowest = static_cast<std::ptrdiff_t>(5.0 / hertz);
  const auto top = static_cast<std::size_t>(std::max_element(power.begin() + lowest, power.end() - 1) - power.begin());
  const double a = std::log(power[top - 1]), b = std::log(power[top]), c = std::log(power[top + 1]);
  return (static_cast<double>(top) + 0.5 * (a - c) / (a - 2.0 * b + c)) * hertz;
}

// Sum of the power spectrum between two frequencies [Hz].
inline double band_power(const Spectrum& s, double low, double high) {
  double sum = 0.0;
  for (std::size_t n = 0; n < s.power.size(); ++n) {
    const double f = static_cast<double>(n) * s.hertz_per_bin;
    if (f >= low && f < high) sum += s.power[n];
  }
  return sum;
}

// Amplitude of a sine of the given frequency [Hz] in x, by correlation over a whole number of periods.
inline double amplitude_at(std::span<const double> x, double frequency) {
  const double periods = std::floor(static_cast<double>(x.size()) * frequency / engine::kSoundRate);
  const auto count = static_cast<std::size_t>(std::lround(periods * engine::kSoundRate / frequency));
  std::complex<double> sum = 0.0;
  for (std::size_t n = 0; n < std::min(count, x.size()); ++n) {
    sum += x[n] * std::polar(1.0, -2.0 * std::numbers::pi * frequency * static_cast<double>(n) / engine::kSoundRate);
  }
  return 2.0 * std::abs(sum) / static_cast<double>(count);
}

// Roughness of a loop at the joint of its end and its start: the second difference at the joint, divided by the largest
// second difference inside the loop. A kink or step gives a large value. A smooth loop gives at most 1.
inline double joint_roughness(std::span<const float> loop) {
  const std::size_t size = loop.size();
  const auto bend = [&](std::size_t n) {
    return std::abs(static_cast<double>(loop[n % size]) - 2.0 * loop[(n + 1) % size] + loop[(n + 2) % size]);
  };
  double inside = 0.0;
  for (std::size_t n = 0; n + 2 < size; ++n) inside = std::max(inside, bend(n));
  return std::max(bend(size - 2), bend(size - 1)) / inside;
}

}  // namespace gearshift::test
