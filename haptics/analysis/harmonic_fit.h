// Amplitude and phase of sampled signals at one known frequency, by a least-squares fit of cos, sin, 1 and t.
#pragma once

#include <complex>

#include <glm/mat3x4.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gearshift::haptics {

// Fits three signals at the same time, in constant memory. Samples may be unevenly spaced. Real-time safe.
class HarmonicFit {
 public:
  // Starts a new fit. omega: angular frequency [rad/s]; start: beginning of the window [s]; length: approximate
  // duration of the window [s], a whole number of periods.
  void begin(double omega, double start, double length) noexcept;
  void add(double time, glm::dvec3 values) noexcept;  // time [s]; values of the three signals, in any unit
  int samples() const noexcept { return samples_; }

  // The fitted signal is Re(value exp(j omega t)) plus an offset and a drift, with t counted from the window's start.
  // deviation: standard deviation of the real and of the imaginary part of `value`, estimated from the residuals.
  struct Phasor {
    std::complex<double> value;
    double deviation = 0.0;
  };
  Phasor phasor(int i) const noexcept;  // result for signal i; valid after at least 5 samples

 private:
  double omega_ = 0.0, start_ = 0.0, length_ = 1.0;
  int samples_ = 0;
  glm::dmat4 normal_{0.0};       // sum over all samples of basis * basis^T, basis = (cos, sin, 1, t), t scaled
  glm::dmat3x4 projected_{0.0};  // sum over all samples of basis * values^T
  glm::dvec3 squares_{0.0};      // sum of values^2
};

}  // namespace gearshift::haptics
