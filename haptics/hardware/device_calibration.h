// Calibration of one stick: measured once, stored in a file, loaded at every start.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <glm/mat2x2.hpp>

#include "haptics/device/haptic_device.h"
#include "haptics/files/parameter.h"
#include "haptics/hardware/report_scheduler.h"
#include "haptics/hid/hid_port.h"
#include "haptics/joystick/plant.h"

namespace gearshift::haptics {

// One axis of the lever: select or shift.
struct LeverAxisCalibration {
  int usage = 0x30;  // HID usage of the axis (Generic Desktop page); only X (0x30) and Y (0x31) have motors
  // [counts] readings at the left or back stop, at rest, and at the right or forward stop. If low > high, the counts
  // decrease from left to right or from back to front. If low == high, the stops are not known.
  double low = 0.0, centre = 0.0, high = 0.0;
  double travel = 0.0;            // [m] knob travel from stop to stop; 0: not known
  double full_force = 0.0;        // [N] force at the knob at full magnitude; 0: not known
  int constant_sign = 0;          // +1: a positive magnitude pushes right or forward; -1: left or back; 0: not measured
  int spring_sign = 0;            // +1: a spring pulls to its centre; -1: it pushes away; 0: not measured
  double spring_stiffness = 0.0;  // [N/m] stiffness at the knob at the maximum coefficient; 0: not measured
  AxisModel handle{0.0, 0.0, 0.0};  // handle's mass, damping and stiffness, without a hand; mass 0: not measured
  int damper_sign = 0;              // +1: a damper brakes; -1: it drives the lever; 0: not measured
  double damper_strength = 0.0;     // [N s/m] damping at the knob at the maximum coefficient; 0: not measured
  double spring_dead_band = 0.0;  // [1] measured width of a spring's dead band over the commanded one; 0: not measured
  // [N/m] centring spring that the stick adds while its motors are on; 0: none, or not measured
  double own_spring = 0.0;
  double friction = 0.0;  // [N] the handle's dry friction; 0: too little to measure, or not measured
  // [1] constant forces grow evenly up to this magnitude, and stronger ones are not used; 0: not measured
  double constant_limit = 0.0;
  double constant_slope = 1.0;  // [1] measured force per magnitude up to the limit, over full_force

  // [1] with sign: motion of the other axis over that of this one, by a constant force. A lever cancels it
  // (force_coupling).
  double constant_coupling = 0.0;
  // [1] motion of the other axis over that of this one, by each family of effects, after that; -1: not measured
  double constant_cross_talk = -1.0, spring_cross_talk = -1.0, damper_cross_talk = -1.0;

  double force_per_magnitude() const noexcept { return full_force * constant_slope; }  // [N]
  double max_magnitude() const noexcept { return constant_limit > 0.0 ? constant_limit : 1.0; }
};

inline constexpr FileRange kCounts{-2147483648.0, 4294967295.0}, kMeasuredSign{-1.0, 1.0}, kCrossTalk{-1.0, 10.0};

template <>
inline constexpr Parameter<LeverAxisCalibration> kParameters<LeverAxisCalibration>[] = {
    {&LeverAxisCalibration::low, "low", "low_counts", kCounts, "at the left or back stop"},
    {&LeverAxisCalibration::centre, "centre", "centre_counts", kCounts, "at rest"},
    {&LeverAxisCalibration::high, "high", "high_counts", kCounts, "at the right or forward stop"},
    {&LeverAxisCalibration::travel, "travel", "travel_m", FileRange{0.0, 1.0}, "travel of the knob from stop to stop"},
    {&LeverAxisCalibration::full_force, "full_force", "full_force_n", FileRange{0.0, 200.0},
     "force at the knob at full magnitude"},
    {&LeverAxisCalibration::constant_sign, "constant_sign", "constant_sign", kMeasuredSign,
     "1: a positive force pushes right or forward; -1: left or back"},
    {&LeverAxisCalibration::spring_sign, "spring_sign", "spring_sign", kMeasuredSign,
     "1: a spring pulls to its centre; -1: pushes away from it"},
    {&LeverAxisCalibration::spring_stiffness, "spring_stiffness", "spring_stiffness_n_per_m", FileRange{0.0, 1e5},
     "strongest spring"},
    {&LeverAxisCalibration::damper_sign, "damper_sign", "damper_sign", kMeasuredSign,
     "1: a damper brakes the lever; -1: drives it"},
    {&LeverAxisCalibration::damper_strength, "damper_strength", "damper_n_s_per_m", FileRange{0.0, 1e3},
     "strongest damper"},
    {&LeverAxisCalibration::spring_dead_band, "spring_dead_band", "spring_dead_band", FileRange{0.0, 10.0},
     "its measured over its commanded width"},
    {&LeverAxisCalibration::own_spring, "own_spring", "own_spring_n_per_m", FileRange{0.0, 1e5},
     "centring by its motors; 0: none"},
    {&LeverAxisCalibration::friction, "friction", "friction_n", FileRange{0.0, 1e3}, "dry friction"},
    {&LeverAxisCalibration::constant_limit, "constant_limit", "constant_limit", FileRange{0.0, 1.0},
     "forces grow evenly up to this magnitude"},
    {&LeverAxisCalibration::constant_slope, "constant_slope", "constant_slope", FileRange{0.01, 10.0},
     "force per magnitude, over full_force_n"},
    {&LeverAxisCalibration::constant_coupling, "constant_coupling", "constant_coupling", FileRange{-0.9, 0.9},
     "motion of the other axis by a force, cancelled"},
    {&LeverAxisCalibration::constant_cross_talk, "constant_cross_talk", "constant_cross_talk", kCrossTalk,
     "motion of the other axis over this one's; -1: not measured"},
    {&LeverAxisCalibration::spring_cross_talk, "spring_cross_talk", "spring_cross_talk", kCrossTalk, ""},
    {&LeverAxisCalibration::damper_cross_talk, "damper_cross_talk", "damper_cross_talk", kCrossTalk, ""},
};
static_assert(describes_all(&LeverAxisCalibration::usage, &LeverAxisCalibration::handle));

struct DeviceTiming {
  double input_interval = 0.0;   // [s] median time between readings; 0: not measured
  double output_interval = 0.0;  // [s] mean time between outputs
  double delay = 0.0;            // [s] time from sending a force until readings show its effect
  double jitter = 0.0;           // [s] 99th percentile of the input interval minus its median
  double restart_gap = 0.0;      // [s] silence of an effect each time it is renewed
};

inline constexpr FileRange kSeconds{0.0, 1.0};

template <>
inline constexpr Parameter<DeviceTiming> kParameters<DeviceTiming>[] = {
    {&DeviceTiming::input_interval, "input_interval", "input_interval_s", kSeconds, "time between two readings"},
    {&DeviceTiming::output_interval, "output_interval", "output_interval_s", kSeconds,
     "time between two force commands"},
    {&DeviceTiming::delay, "delay", "delay_s", kSeconds, "time from sending a force to its effect"},
    {&DeviceTiming::jitter, "jitter", "jitter_s", kSeconds, "99 % of the readings are at most this late"},
    {&DeviceTiming::restart_gap, "restart_gap", "restart_gap_s", kSeconds, "silence when an effect is renewed"},
};
static_assert(DescribesAll<DeviceTiming>);

struct StickButtons {
  int press = 0, lift = 0, stop = 0;  // numbers from 1; 0: none
};

inline constexpr FileRange kButton{0.0, 64.0};

template <>
inline constexpr Parameter<StickButtons> kParameters<StickButtons>[] = {
    {&StickButtons::press, "press", "press", kButton, "pushes the knob down"},
    {&StickButtons::lift, "lift", "lift", kButton, "lifts the ring"},
    {&StickButtons::stop, "stop", "stop", kButton, "switches the motors off"},
};
static_assert(DescribesAll<StickButtons>);

struct DeviceCalibration {
  std::uint16_t vendor = 0, product = 0;
  std::string serial;  // empty: the device has none
  std::string name;
  LeverAxisCalibration select, shift;
  DeviceTiming timing;
  StickStyle style;
  std::string springs_refused, dampers_refused;  // why they measured wrong and are not used; empty: they did not
  bool select_by_position = false;               // select has no motor: forces act along shift only
  bool holds_spring = false;                     // a spring without a force keeps the stick from centring by itself
  int effects_at_once = 0;                       // so many effects act at the same time, or more; 0: not measured
  StickButtons buttons;

  bool has_stops() const noexcept { return select.low != select.high && shift.low != shift.high; }
  bool has_travel() const noexcept { return select.travel > 0.0 && shift.travel > 0.0; }
  bool has_range() const noexcept { return has_stops() && has_travel(); }
  bool has_force() const noexcept { return select.full_force > 0.0 && shift.full_force > 0.0; }
  bool has_polarity() const noexcept {
    return shift.constant_sign != 0 && (select.constant_sign != 0 || select_by_position);
  }
  bool has_strength() const noexcept {
    return shift.constant_limit > 0.0 && (select.constant_limit > 0.0 || select_by_position);
  }
  bool has_timing() const noexcept { return timing.input_interval > 0.0; }
  bool has_springs() const noexcept { return select.spring_dead_band > 0.0 && shift.spring_dead_band > 0.0; }
  bool has_handle() const noexcept {
    return shift.handle.mass > 0.0 && (select.handle.mass > 0.0 || select_by_position);
  }
};

// Properties of the effects besides their style.
template <>
inline constexpr Parameter<DeviceCalibration> kParameters<DeviceCalibration>[] = {
    {&DeviceCalibration::select_by_position, "select_by_position", "select_by_position", FileRange{},
     "select has no motor"},
    {&DeviceCalibration::holds_spring, "holds_spring", "holds_spring", FileRange{},
     "an idle spring keeps it from centring itself"},
    {&DeviceCalibration::effects_at_once, "effects_at_once", "at_once", FileRange{0.0, 4.0}, "act at the same time"},
};
static_assert(describes_all(&DeviceCalibration::vendor, &DeviceCalibration::product, &DeviceCalibration::serial,
                            &DeviceCalibration::name, &DeviceCalibration::select, &DeviceCalibration::shift,
                            &DeviceCalibration::timing, &DeviceCalibration::style, &DeviceCalibration::springs_refused,
                            &DeviceCalibration::dampers_refused, &DeviceCalibration::buttons));

// Values for a stick that was not measured. They are on the safe side: a slow stick with a light, lightly damped
// handle.
inline constexpr DeviceTiming kUnmeasuredTiming{0.002, 0.002, 0.004, 0.0};
inline constexpr AxisModel kUnmeasuredHandle{0.05, 1.0, 0.0};
inline constexpr double kMinSpring = 100.0;  // [N/m] weaker springs are not used for device walls
inline constexpr double kMinDamper = 3.0;    // [N s/m] weaker dampers are not used for device walls

// [s] Longest time from a motion of the lever to the effect of the force computed from it. It is the sum of the
// reading's age (at most one input interval plus jitter), the wait while the other axis's output is sent (one output
// interval), and the device's delay.
double answer_time(const DeviceTiming& timing) noexcept;

// answer_time() in cycles of `period` [s]: the smallest delay >= 0 for which (1 + delay) * period >= answer_time().
// Throws std::invalid_argument if the delay is longer than the loop supports; the message names a rate that would work,
// if there is one.
int delay_cycles(const DeviceTiming& timing, double period);

// Forces at the knob from the forces that the motors of select and shift were commanded to make [N].
glm::dmat2 force_coupling(const DeviceCalibration& calibration) noexcept;

// The device's properties for the loop. Until the polarity is measured, max_force is 0. Throws as delay_cycles() does.
DeviceSpec spec_of(const DeviceCalibration& calibration, double period);

// The path VENDOR_PRODUCT[_SERIAL].toml in the folder. Characters of the serial number other than letters, digits and
// '-' are replaced by '_'.
std::filesystem::path calibration_file(const std::filesystem::path& folder, const HidIdentity& device);

// Returns an empty value if there is no file. Throws FileError if the file is invalid.
std::optional<DeviceCalibration> read_calibration(const std::filesystem::path& file);
DeviceCalibration parse_calibration(std::string_view text, const std::string& file_name);

// Writes every number losslessly and creates the folder if needed. Throws FileError if the file cannot be written or
// the text cannot be read back; the old file is then left untouched.
void write_calibration(const DeviceCalibration& calibration, const std::filesystem::path& file);
std::string calibration_text(const DeviceCalibration& calibration);

}  // namespace gearshift::haptics
