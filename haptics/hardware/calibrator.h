// Measures a stick through its driver, step by step: what a person shows it, then what it does by itself with the hands
// off. Each step puts what it found into the calibration, or refuses nonsense and leaves it as it was. Until the polarity
// is known no force is above kCautious.
//
//   a person shows   find_axis (right, then forward), measure_range, find_button
//   a person knows   set_numbers: the travel and the full force at the knob, by a ruler and a spring scale
//   hands off        measure_polarity, measure_timing, measure_handle, measure_springs
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "haptics/hardware/device_calibration.h"
#include "haptics/hardware/pid_driver.h"
#include "haptics/hardware/pulse_response.h"
#include "haptics/hardware/stick_rig.h"

namespace gearshift {

inline constexpr double kCautious = 0.10;  // [1] of the full force

enum class CalibrationStep : std::uint8_t { range, numbers, polarity, timing, handle, springs };
const char* calibration_step_name(CalibrationStep step) noexcept;

// What is not known yet, in the order in which it can be found. springs: the device makes springs (PidAbility).
std::vector<CalibrationStep> missing_steps(const DeviceCalibration& calibration, bool springs);

enum class LeverButton : std::uint8_t { press, lift, stop };

class Calibrator {
 public:
  // Whatever `known` has already is kept. The driver must outlive it, be prepared and stream.
  // The calibrator is its haptic side.
  Calibrator(PidDriver& driver, CalibrationTick tick, const DeviceCalibration& known);

  const DeviceCalibration& calibration() const noexcept { return calibration_; }

  // All of them return one sentence about what was found, and throw CalibrationRefused with one about why not.

  // The person holds the lever still, then pushes it right (forward) as far as it goes and keeps it there: which axis of
  // the device moves, and which way. `seconds` for all of it. Select first.
  std::string find_axis(bool select, double seconds);
  // The person moves the lever to all its ends, then lets go of it for the last second. After both find_axis().
  std::string measure_range(double seconds);
  // [m] 0.02 to 0.5, [N] 0.5 to 100.
  std::string set_numbers(double select_travel, double shift_travel, double full_force);
  // The person presses that button within so many seconds. Whatever is held at first does not count.
  std::string find_button(LeverButton button, double seconds);

  std::string measure_polarity();  // of constant forces and of springs, per axis
  std::string measure_timing();    // intervals, jitter, delay
  std::string measure_handle();    // m, b, k; after set_numbers()
  // N/m and N s/m; after set_numbers(). The way of a damper is found at kCautious of its greatest coefficient. Where
  // only the dampers are refused the springs are known all the same.
  std::string measure_springs();

 private:
  struct FoundAxis {
    int usage = 0;  // 0: not found yet
    int sign = 0;   // of its counts to the right, or forward
  };
  struct AxisPlace {
    std::size_t report = 0;  // among the report's axes
    std::size_t motor = 0;   // of the driver's two
    double sign = 1.0;       // of its counts
  };

  AxisPlace place_of(const LeverAxisCalibration& axis) const;
  std::size_t report_axis(int usage) const;
  void require_range() const;
  void require_polarity() const;
  static LeverAxisCalibration range_of(const std::string& name, const FoundAxis& found, const std::vector<double>& seen,
                                       double centre, double whole);
  int constant_sign(StickRig& rig, const AxisPlace& place, const std::string& name) const;
  double push(StickRig& rig, const AxisPlace& place, const PidWish& wish) const;
  int spring_sign(StickRig& rig, const AxisPlace& place) const;
  DeviceTiming measure_intervals(StickRig& rig) const;
  Pulse pulse(StickRig& rig, const AxisPlace& place, const PidWish& rest, double magnitude) const;
  std::array<Pulse, 2> pulses(StickRig& rig, const AxisPlace& place, const PidWish& rest, double& magnitude) const;
  PulseFit fit(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name, double damper = 0.0) const;
  static PulseFit fit_of(std::span<const Pulse> pulses, const std::string& name);
  static PulseFit checked(const PulseFit& found, const LeverAxisCalibration& axis, const std::string& name);
  double spring_stiffness(StickRig& rig, const LeverAxisCalibration& axis) const;
  std::string measure_dampers();
  double damping_by(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name, double damper) const;

  PidDriver& driver_;
  CalibrationTick tick_;
  DeviceCalibration calibration_;
  std::array<FoundAxis, 2> found_{};  // select, shift
};

}  // namespace gearshift
