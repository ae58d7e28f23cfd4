// Random draws that are equal on every machine: std::mt19937_64 is standardised, the library's distributions are not.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace gearshift::lab {

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * 0x1p-53 * static_cast<double>(engine_() >> 11);
  }
  double decades(double low, double high) { return low * std::exp(between(0.0, std::log(high / low))); }
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  bool happens(double probability) { return between(0.0, 1.0) < probability; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace gearshift::lab
