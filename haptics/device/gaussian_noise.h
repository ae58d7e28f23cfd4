// Normally distributed noise. Equal seeds give equal noise with every standard library.
#pragma once

#include <cstdint>
#include <random>

namespace gearshift::haptics {

// Gaussian noise by the Box-Muller method on std::mt19937_64. std::normal_distribution is not used, because the
// standard does not specify its sequence, and it would differ between standard libraries.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : engine_(seed) {}

  double next() noexcept;  // next value: mean 0, standard deviation 1. Real-time safe

 private:
  double uniform() noexcept;  // in (0, 1]

  std::mt19937_64 engine_;
};

}  // namespace gearshift::haptics
