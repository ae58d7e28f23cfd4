// What the motors can give: peak force for a while, the continuous force for ever.
#pragma once

namespace gearshift {

struct ActuatorLimits {
  double peak_force = 31.7;         // [N] 3.8 N m / 0.12 m
  double continuous_force = 10.83;  // [N] 1.3 N m / 0.12 m: Table 2's "10.83 Nm" is this tip force in newtons
  double overload_time = 5.0;       // [s] that the peak may last from cold (i^2 t)
};

// One axis' motor. Heat above the continuous force is counted as i^2 t; when the budget is spent the axis is
// held to the continuous force until half of it is regained. Under a constant force F above the continuous
// force Fc this takes overload_time (Fp^2 - Fc^2) / (F^2 - Fc^2) from cold, Fp the peak.
class Actuator {
 public:
  explicit Actuator(const ActuatorLimits& limits) noexcept : limits_(limits) {}

  // Force really delivered [N] for the commanded one over the next `period` [s]; none for what is no number.
  double deliver(double commanded, double period) noexcept;

  bool overloaded() const noexcept { return overloaded_; }

 private:
  ActuatorLimits limits_;
  double heat_ = 0.0;  // [N^2 s] above continuous
  bool overloaded_ = false;
};

}  // namespace gearshift
