// Force limits of the motors: a peak force for a limited time, a continuous force indefinitely.
#pragma once

#include "haptics/files/parameter.h"

namespace gearshift::haptics {

struct ActuatorLimits {
  double peak_force = 31.7;         // [N] peak torque / radius: 3.8 N m / 0.12 m
  double continuous_force = 10.83;  // [N] continuous torque / radius: 1.3 N m / 0.12 m; paper's Table 2: "10.83 Nm"
  double overload_time = 5.0;       // [s] time for which a cold motor can hold the peak force (i^2 t limit)
  bool operator==(const ActuatorLimits&) const = default;
};

template <>
inline constexpr Parameter<ActuatorLimits> kParameters<ActuatorLimits>[] = {
    {&ActuatorLimits::peak_force, "peak_force", "peak_force_n", FileRange{0.0, 1e4},
     "3.8 N m of the motor over 0.12 m."},
    {&ActuatorLimits::continuous_force, "continuous_force", "continuous_force_n", FileRange{0.0, 1e4},
     "1.3 N m over 0.12 m; printed in Table 2 as \"10.83 Nm\".", "", "", "", Display{}, &ActuatorLimits::peak_force},
    {&ActuatorLimits::overload_time, "overload_time", "overload_time_s", FileRange{0.0, 1e4},
     "Time for which a cold motor can hold the peak force."},
};
static_assert(DescribesAll<ActuatorLimits>);

// The motor of one axis. Forces above the continuous force heat the motor with the square of the force (i^2 t). Once
// the heat budget is used up, the force is limited to the continuous force until half of the budget has recovered. A
// cold motor can hold a constant force F for the time overload_time * (Fp^2 - Fc^2) / (F^2 - Fc^2), with peak force Fp
// and continuous force Fc < F.
class Actuator {
 public:
  explicit Actuator(const ActuatorLimits& limits) noexcept : limits_(limits) {}

  // Returns the force [N] that the motor delivers for the commanded force during the next `period` [s]; 0 if the
  // command is not finite.
  double deliver(double commanded, double period) noexcept;

 private:
  ActuatorLimits limits_;
  double heat_ = 0.0;  // [N^2 s] heat beyond what the continuous force produces
  bool is_overloaded_ = false;
};

}  // namespace gearshift::haptics
