// Command to a stick, as fractions of its full force and of its axes' full deflection.
#pragma once

#include <array>

namespace gearshift::haptics {

struct PidSpring {  // fractions as in PidCondition
  double centre = 0.0, dead_band = 0.0, coefficient = 0.0, saturation = 1.0;
  bool operator==(const PidSpring&) const = default;
};

// A command is in effect until the next command. Arrays are in the device's axis order: X, Y.
struct StickCommand {
  bool enabled = false;               // false: actuators off
  std::array<double, 2> constant{};   // [1] -1 to 1, fraction of the full force
  std::array<PidSpring, 2> spring{};  // coefficient 0: none
  std::array<double, 2> damper{};     // [1] -1 to 1, fraction of the maximum coefficient; 0: none
  double push_time = 0.0;             // [s] the constant forces end after this time by themselves; 0: they do not
  double restart_interval = 0.0;      // [s] 0: renewals as needed; otherwise every effect is started again this often
  std::array<bool, 2> pushes{true, true};  // false: the axis's constant force does not even play
  bool holds_spring = false;  // the spring plays even without a force, so that the stick does not centre by itself
  bool operator==(const StickCommand&) const = default;
};

}  // namespace gearshift::haptics
