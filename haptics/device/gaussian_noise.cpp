#include "haptics/device/gaussian_noise.h"

#include <cmath>
#include <numbers>

namespace gearshift::haptics {

double GaussianNoise::uniform() noexcept {
  constexpr double kStep = 1.0 / 9007199254740992.0;  // 2^-53
  return (static_cast<double>(engine_() >> 11) + 1.0) * kStep;
}

double GaussianNoise::next() noexcept {
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

}  // namespace gearshift::haptics
