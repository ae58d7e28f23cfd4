// Normally distributed noise that depends only on the seed, not on the standard library.
#pragma once

#include <cstdint>
#include <random>

namespace gearshift::haptics {

// Box-Muller method on std::mt19937_64, because the standard specifies the sequence of that engine, but not that of
// std::normal_distribution.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : engine_(seed) {}

  double next() noexcept;  // mean 0, standard deviation 1. Real-time safe

 private:
  double uniform() noexcept;  // in (0, 1]

  std::mt19937_64 engine_;
};

}  // namespace gearshift::haptics
