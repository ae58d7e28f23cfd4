// Motor force limits: peak force for a limited time, continuous force indefinitely.
#pragma once

namespace gearshift::haptics {

struct ActuatorLimits {
  double peak_force = 31.7;         // [N] 3.8 N m / 0.12 m
  double continuous_force = 10.83;  // [N] 1.3 N m / 0.12 m; printed in Table 2 as "10.83 Nm"
  double overload_time = 5.0;       // [s] how long a cold motor can hold the peak force (i^2 t)
};

// The motor of one axis. Load above the continuous force heats it as i^2 t; once the heat budget is used up, the force
// is limited to the continuous force until half of the budget has recovered. A constant force F above the continuous
// force Fc uses up the budget of a cold motor in overload_time (Fp^2 - Fc^2) / (F^2 - Fc^2), with the peak force Fp.
class Actuator {
 public:
  explicit Actuator(const ActuatorLimits& limits) noexcept : limits_(limits) {}

  // Force [N] delivered for the commanded force during the next `period` [s]; 0 if the command is not finite.
  double deliver(double commanded, double period) noexcept;

  bool is_overloaded() const noexcept { return is_overloaded_; }

 private:
  ActuatorLimits limits_;
  double heat_ = 0.0;  // [N^2 s] heat above that of the continuous load
  bool is_overloaded_ = false;
};

}  // namespace gearshift::haptics
