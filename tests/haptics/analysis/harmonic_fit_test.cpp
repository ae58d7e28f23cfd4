#include "haptics/analysis/harmonic_fit.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include <doctest/doctest.h>

#include "haptics/device/gaussian_noise.h"

using namespace gearshift::haptics;

namespace {

constexpr double kOmega = 2.0 * std::numbers::pi * 3.0;

double wave(std::complex<double> phasor, double t) {
  return (phasor * std::exp(std::complex<double>(0.0, kOmega * t))).real();
}

}  // namespace

TEST_CASE("phasors through offset, drift and uneven samples") {
  const std::complex<double> a{0.3, -0.7}, b{-2e-6, 1e-6};
  std::mt19937_64 engine(5);
  HarmonicFit fit;
  fit.begin(kOmega, 100.0, 2.0);
  double t = 0.0;
  while (t < 2.0) {
    fit.add(100.0 + t, {wave(a, t) + 5.0 - 3.0 * t, wave(b, t), 0.25});
    t += 1e-3 * (0.5 + static_cast<double>(engine() >> 11) / 9007199254740992.0);
  }
  CHECK(std::abs(fit.phasor(0).value - a) < 1e-10);
  CHECK(std::abs(fit.phasor(1).value - b) < 1e-16);
  CHECK(std::abs(fit.phasor(2).value) < 1e-12);
  CHECK(fit.phasor(0).deviation < 1e-7);
}

TEST_CASE("the stated deviation matches the scatter under white noise, and begin() starts over") {
  GaussianNoise noise(3);
  HarmonicFit fit;
  double squares = 0.0, stated = 0.0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    fit.begin(kOmega, 0.0, 1.0);
    for (int n = 0; n < 200; ++n) fit.add(5e-3 * n, {wave(1.0, 5e-3 * n) + 0.1 * noise.next(), 0.0, 0.0});
    CHECK(fit.samples() == 200);
    squares += std::norm(fit.phasor(0).value - 1.0) / 2.0;
    stated += fit.phasor(0).deviation / kRuns;
  }
  // The expected deviation is sigma sqrt(2 / n) = 0.01, with noise of deviation sigma = 0.1 and n = 200 samples.
  CHECK(std::sqrt(squares / kRuns) == doctest::Approx(0.01).epsilon(0.1));
  CHECK(stated == doctest::Approx(0.01).epsilon(0.03));
}
