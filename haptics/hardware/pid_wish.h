// What a stick shall do, in shares of its full force and of its axes' full deflection.
#pragma once

#include <array>

namespace gearshift {

struct PidSpring {  // as PidCondition: shares of the axis' full deflection and of the full force
  double centre = 0.0, dead_band = 0.0, coefficient = 0.0, saturation = 1.0;
  bool operator==(const PidSpring&) const = default;
};

// What the device shall do from now on, axis by axis as it counts them: X, Y.
struct PidWish {
  bool enabled = false;               // else the actuators are off
  std::array<double, 2> constant{};   // [1] -1 to 1 of the full force
  std::array<PidSpring, 2> spring{};  // coefficient 0: none
  std::array<double, 2> damper{};     // [1] -1 to 1 of its greatest coefficient; 0: none
  bool operator==(const PidWish&) const = default;
};

}  // namespace gearshift
