// Calibrates a stick through its driver, step by step: first the steps in which the user moves the lever, then the
// measurements without a hand on the lever. Each step writes its result into the calibration; a step that fails throws
// and changes nothing. Until the polarity is known, no force exceeds kCautiousForce.
//
//   the user moves the lever     find_axis (right, then forward), measure_range, find_button
//   the user enters numbers      set_numbers: travel and full force at the knob, measured with ruler and spring scale
//   no hand on the lever         measure_polarity, measure_timing, measure_strength, measure_handle, measure_springs
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/hardware/device_calibration.h"
#include "haptics/hardware/pid_driver.h"
#include "haptics/hardware/pulse_response.h"
#include "haptics/hardware/stick_rig.h"

namespace gearshift::haptics {

inline constexpr double kCautiousForce = 0.10;  // [1] fraction of the full force

enum class CalibrationStep : std::uint8_t { range, numbers, polarity, timing, strength, handle, springs };

// Calibration steps still to do, in the required order. `springs`, `dampers`: true if the device has them (PidAbility).
std::vector<CalibrationStep> missing_steps(const DeviceCalibration& calibration, bool springs, bool dampers);

enum class LeverButton : std::uint8_t { press, lift, stop };

class Calibrator {
 public:
  // `known`: the calibration to start from. The driver must be prepared and streaming, and must outlive the calibrator.
  // The calibrator sends the driver's commands, so no other thread may send any.
  Calibrator(PidDriver& driver, CalibrationTick tick, const DeviceCalibration& known, bool has_springs = true);

  const DeviceCalibration& calibration() const noexcept { return calibration_; }

  // Every step returns one sentence with its result, or throws CalibrationRefused with one sentence that says why it
  // failed.

  // Finds the device axis that moves, and its direction. The user holds the lever still, then pushes it fully right
  // (select) or forward (shift) and holds it there, all within `seconds`. Call it for the select axis first.
  std::string find_axis(bool select, double seconds);
  // Measures each axis's counts at both stops and at rest. The user moves the lever to all its stops, then releases it
  // for the last second. Call find_axis() for both axes first.
  std::string measure_range(double seconds);
  // Stores each axis's travel at the knob between the stops (0.02 to 0.5 m) and its force at the knob at full magnitude
  // (0.5 to 100 N).
  std::string set_numbers(glm::dvec2 travel, glm::dvec2 full_force);
  // Waits up to `seconds` for a button press and stores the button's number. Ignores buttons already held at the start.
  std::string find_button(LeverButton button, double seconds);

  std::string measure_polarity();  // sign of constant forces per axis, and how their effects must name the axis
  std::string measure_timing();    // intervals, jitter, delay, silence when an effect is renewed
  // Forces at 5, 20, 60 and 100 % of the magnitude, to both sides, each changed and reversed while it acts. If they do
  // not grow evenly, only the even part is used.
  std::string measure_strength();
  // Mass, damping, stiffness, and how much of it is a spring of the stick's motors; call it after set_numbers().
  std::string measure_handle();
  // Measures sign, stiffness [N/m] and dead band of springs, and sign and strength [N s/m] of dampers; call it after
  // set_numbers(). The sign of a damper is measured at the fraction kCautiousForce of its maximum coefficient. Springs
  // or dampers that measure wrong are not used; the sentence says so.
  std::string measure_springs();

 private:
  struct FoundAxis {
    int usage = 0;  // 0: not found yet
    int sign = 0;   // +1: counts rise when the lever moves right or forward; -1: they fall
  };
  struct AxisPlace {
    std::size_t report = 0;  // index of the axis in the report
    std::size_t motor = 0;   // index of the motor in the driver
    double sign = 1.0;       // +1: counts rise when the lever moves right or forward; -1: they fall
  };

  AxisPlace axis_place(const LeverAxisCalibration& axis) const;
  std::size_t report_axis(int usage) const;
  void require_range() const;
  void require_polarity() const;
  static LeverAxisCalibration range_of(const std::string& name, const FoundAxis& found,
                                       const std::vector<double>& positions, double centre, double range);
  struct Signs {
    std::array<int, 2> sign{};                       // select, shift
    double magnitude = 0.0;                          // [1] that moved both axes
    std::array<double, 2> cross_talk{}, coupling{};  // as in LeverAxisCalibration
    StickStyle style;
    std::string only_shift;  // why only shift's forces can be used; empty: both can
  };
  struct Motion {
    double moved = 0.0, other = 0.0;  // [1] of the pushed axis and of the other one, fractions of their ranges
  };
  struct Spring {
    int sign = 0;
    double stiffness = 0.0;  // [N/m]
    double dead_band = 0.0;  // [1]
    double cross_talk = 0.0;
  };

  std::array<AxisPlace, 2> places() const { return {axis_place(calibration_.select), axis_place(calibration_.shift)}; }
  LeverAxisCalibration& axis_of(std::size_t i) { return i == 0 ? calibration_.select : calibration_.shift; }
  const LeverAxisCalibration& axis_of(std::size_t i) const { return i == 0 ? calibration_.select : calibration_.shift; }
  StickCommand idle_command() const;
  StickCommand only(std::size_t motor) const;
  StickCommand with_weak(bool spring, bool damper) const;
  void apply(StickStyle style);
  Signs constant_signs();
  Signs constant_signs_by(StickStyle style);
  bool keeps_forces();
  int constant_sign(StickRig& rig, std::size_t axis, Signs& found) const;
  bool acts_beside(StickRig& rig, const AxisPlace& axis, const StickCommand& fewer, const StickCommand& more) const;
  // Indices of the axes whose motors are used: select and shift, or shift only.
  std::span<const std::size_t> motors() const noexcept;
  void cancel_cross_talk(StickRig& rig, Signs& found) const;
  double coupling(std::size_t axis, const Motion& there, const Motion& back) const;
  Motion push(StickRig& rig, const AxisPlace& place, const StickCommand& idle, const StickCommand& command) const;
  static double cross_talk(const Motion& there, const Motion& back) noexcept;
  static void check_cross_talk(const char* effect, std::size_t axis, double cross_talk);
  std::string measure_springs_anew();
  std::string measure_spring_strengths();
  std::array<Spring, 2> find_springs();
  std::array<Spring, 2> springs_twice(StickStyle style);
  std::array<Spring, 2> springs_by(StickStyle style);
  Spring spring_sign(StickRig& rig, const AxisPlace& place) const;
  Motion pull(StickRig& rig, const AxisPlace& place, double coefficient, double offset) const;
  void check_springs_together(StickRig& rig, const std::array<Spring, 2>& springs) const;
  double dead_band(StickRig& rig, const LeverAxisCalibration& axis, const Spring& spring) const;
  DeviceTiming measure_intervals(StickRig& rig) const;
  struct Strength {
    double limit = 1.0, slope = 1.0;   // as in LeverAxisCalibration
    std::array<double, 4> measured{};  // [1] forces over the force at full magnitude
  };
  Strength strength(StickRig& rig, std::size_t axis);
  double gain_at(StickRig& rig, std::size_t axis, double magnitude);
  Pulse double_push(StickRig& rig, std::size_t axis, double magnitude);
  Pulse pulse(StickRig& rig, const AxisPlace& place, const StickCommand& rest, double magnitude) const;
  std::array<Pulse, 2> pulses(StickRig& rig, const AxisPlace& place, const StickCommand& rest, double& magnitude) const;
  double restart_gap(StickRig& rig, const DeviceTiming& timing) const;
  Motion distance_pushed(StickRig& rig, const AxisPlace& place, StickCommand beside,
                         const StickCommand* before = nullptr) const;
  double own_fraction(StickRig& rig, const LeverAxisCalibration& axis) const;
  double distance_returned(StickRig& rig, const AxisPlace& place, const StickCommand& under) const;
  AxisModel handle_of(const PulseFit& found, std::size_t axis) const;
  bool is_stiff(const PulseFit& found, std::size_t axis) const;
  bool spring_helps(StickRig& rig) const;
  PulseFit fit(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name, double damper = 0.0) const;
  static PulseFit validated(const PulseFit& found, const LeverAxisCalibration& axis, const std::string& name);
  double spring_stiffness(StickRig& rig, const LeverAxisCalibration& axis, int sign) const;
  std::string find_dampers();
  std::string measure_dampers_twice();
  std::string measure_dampers();
  void check_dampers_together(StickRig& rig, const DeviceCalibration& found) const;
  double damper_cross_talk(StickRig& rig, std::size_t axis, const DeviceCalibration& found) const;
  double damping_by(StickRig& rig, const LeverAxisCalibration& axis, const std::string& name, double damper) const;

  PidDriver& driver_;
  CalibrationTick tick_;
  bool has_springs_;
  DeviceCalibration calibration_;
  std::array<FoundAxis, 2> found_{};                // select, shift
  std::array<std::optional<PulseFit>, 2> known_{};  // the lever's motion, until the handle is measured
};

}  // namespace gearshift::haptics
