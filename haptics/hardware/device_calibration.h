// What is known of one stick: measured once, kept in a file, used for ever.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "haptics/device/haptic_device.h"
#include "haptics/hid/hid_port.h"
#include "haptics/joystick/plant.h"

namespace gearshift {

// One axis of the lever: select or shift.
struct LeverAxisCalibration {
  int usage = 0x30;  // of the Generic Desktop page: which axis of the device it is. X 0x30 and Y 0x31 have motors
  double low = 0.0, centre = 0.0,
         high = 0.0;        // [counts] at the left or back stop, at rest, at the right or forward stop;
                            // low > high: the device counts the other way; low == high: not known
  double travel = 0.0;      // [m] of the knob from stop to stop; 0: not known
  double full_force = 0.0;  // [N] at the knob at full magnitude; 0: not known
  int constant_sign = 0;    // +1: a positive magnitude pushes right or forward; -1: the other way; 0: not measured
  int spring_sign = 0;      // of its springs: +1 pulls to the centre, -1 pushes away; 0: not measured
  double spring_stiffness = 0.0;    // [N/m] at the knob at the greatest coefficient; 0: not measured
  AxisModel handle{0.0, 0.0, 0.0};  // bare; mass 0: not measured
  int damper_sign = 0;              // of its dampers: +1 brakes, -1 drives; 0: not measured
  double damper_strength = 0.0;     // [N s/m] at the knob at the greatest coefficient; 0: not measured
};

struct DeviceTiming {
  double input_interval = 0.0;   // [s] between two readings, median; 0: not measured
  double output_interval = 0.0;  // [s] between two outputs
  double delay = 0.0;            // [s] from a force that has been sent to its effect, as readings tell it
  double jitter = 0.0;           // [s] p99 of the input interval less its median
};

struct DeviceCalibration {
  std::uint16_t vendor = 0, product = 0;
  std::string serial;  // empty: the device tells none
  std::string name;
  LeverAxisCalibration select, shift;
  DeviceTiming timing;
  int press_button = 0, lift_button = 0, stop_button = 0;  // from 1; 0: none

  bool has_stops() const noexcept { return select.low != select.high && shift.low != shift.high; }
  bool has_travel() const noexcept { return select.travel > 0.0 && shift.travel > 0.0; }
  bool has_range() const noexcept { return has_stops() && has_travel(); }
  bool has_force() const noexcept { return select.full_force > 0.0 && shift.full_force > 0.0; }
  bool has_polarity() const noexcept { return select.constant_sign != 0 && shift.constant_sign != 0; }
  bool has_timing() const noexcept { return timing.input_interval > 0.0; }
  bool has_handle() const noexcept { return select.handle.mass > 0.0 && shift.handle.mass > 0.0; }
};

// What is assumed where it was not measured: on the safe side, a slow stick with a light handle that nothing damps much.
inline constexpr DeviceTiming kUnmeasuredTiming{0.002, 0.002, 0.004, 0.0};
inline constexpr AxisModel kUnmeasuredHandle{0.05, 1.0, 0.0};
inline constexpr double kLeastSpring = 100.0;  // [N/m] weaker ones keep no wall
inline constexpr double kLeastDamper = 3.0;    // [N s/m] nor do these damp it

// [s] From a reading to the effect of the force that answers it, worst case: the reading is one interval and its jitter
// old before it is used, the force waits while the other axis is told, and takes the delay to act.
double answer_time(const DeviceTiming& timing) noexcept;

// Whole cycles of that period which account for it: the least delay >= 0 for which (1 + delay) T is no less than
// answer_time(). Throws std::invalid_argument beyond kMostDelay: the sentence names the rate that would do.
int delay_cycles(const DeviceTiming& timing, double period);

// What the loop may know of it. Without polarity there is no force: max_force is 0. Throws as delay_cycles() does.
DeviceSpec spec_of(const DeviceCalibration& calibration, double period);

// VENDOR_PRODUCT[_SERIAL].toml in the folder, the serial in letters, digits, '-' and '_'.
std::filesystem::path calibration_file(const std::filesystem::path& folder, const HidIdentity& device);

// Nothing where there is no file. Throws FileError: file, line, key, value, range.
std::optional<DeviceCalibration> read_calibration(const std::filesystem::path& file);

// Every number to its last bit. The folder is made where there is none. Throws FileError: it cannot be written, or what
// it says could not be read again; then what was there before still is.
void write_calibration(const DeviceCalibration& calibration, const std::filesystem::path& file);
std::string calibration_text(const DeviceCalibration& calibration);

}  // namespace gearshift
