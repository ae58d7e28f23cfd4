// A force-feedback stick as a haptic device: converts between PidDriver's raw units and metres and newtons.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "haptics/device/haptic_device.h"
#include "haptics/hardware/device_calibration.h"
#include "haptics/hardware/force_watch.h"
#include "haptics/hardware/pid_driver.h"

namespace gearshift::haptics {

// Converts positions of one axis between metres at the knob, counts, and the device's fraction of full deflection.
class LeverAxisMap {
 public:
  LeverAxisMap() = default;
  // `field`: position of the axis in the report, with its logical range [counts]
  LeverAxisMap(const LeverAxisCalibration& axis, const BitField& field) noexcept;

  double metres(double counts) const noexcept;  // linear on each side of the centre, also beyond the stops
  double counts(double metres) const noexcept;
  double deflection(double metres) const noexcept;    // [1] -1 to 1 from end to end of the logical range, clamped
  double position(double deflection) const noexcept;  // [m]

 private:
  double centre_ = 0.0, middle_ = 0.0, half_range_ = 1.0;  // [counts]
  double below_ = 1.0, above_ = 1.0;                       // [m] distance per count, on the low and on the high side
};

// The stick's stop button, over all levers that use the stick one after the other. A button that is held from the
// start, as a switch may be, is ignored until it has been released once.
struct StopButton {
  bool was_released = false;
};

class PidLever final : public HapticDevice {
 public:
  // The driver must outlive the lever, and so must `stop`, if given. `period`: period of the loop [s]. Throws
  // std::invalid_argument if the calibration has no range, the stick lacks an axis, or the stick's delay is longer than
  // the loop supports.
  PidLever(const DeviceCalibration& calibration, PidDriver& driver, double period, StopButton* stop = nullptr);
  ~PidLever() override { driver_.release(); }
  PidLever(const PidLever&) = delete;
  PidLever& operator=(const PidLever&) = delete;

  const DeviceSpec& spec() const noexcept override { return spec_; }
  // The reading is fresh if a new report has arrived from the device. These sticks do not measure the actuator force,
  // so it is computed from the forces sent and from the device walls. After a reconnect, or after the driver has
  // switched the motors off, one reading has `stop` set, so that the user has to arm the lever again.
  LeverReading read(std::int64_t now_ns) noexcept override;
  void switch_on() noexcept override { command_.enabled = drives(); }  // sent with the next write()
  void write(glm::dvec2 force) noexcept override;                      // no force until the polarity is measured
  void set_device_walls(const LeverWalls& walls) noexcept override;
  void release() noexcept override;

 private:
  struct Axis {
    LeverAxisMap map;
    std::size_t report = 0;        // index of the axis in the report
    std::size_t motor = 0;         // index of the motor in the driver: X, Y
    double full_force = 0.0;       // [N] of motor and springs together; 0: no motor, or its force is not known
    double per_magnitude = 0.0;    // [N] constant force per magnitude
    double limit = 1.0;            // [1] largest magnitude
    double sign = 0.0;             // sign of constant forces: +1, -1, or 0 if there is no motor
    double spring = 0.0;           // signed spring coefficient of the device walls; 0: no device walls
    double spring_strength = 0.0;  // [N/m] signed, at the maximum coefficient
    double damper_strength = 0.0;  // [N s/m] signed, at the maximum coefficient
    double dead_band = 1.0;        // [1] measured width of a spring's dead band over the commanded one
    double damper = 0.0;           // signed damper coefficient of the device walls; 0: none
  };

  Axis make_axis(const LeverAxisCalibration& calibration, bool drives) const;
  double coefficient(PidEffect effect, int sign, double wanted, double strongest) const noexcept;
  glm::dvec2 constant_force(const StickState& state) const noexcept;  // [N]
  StickForces forces_of(const StickState& state) const noexcept;
  glm::dvec2 motor_force(const StickState& state, glm::dvec2 position) const noexcept;
  bool has_button(const LeverCounts& counts, int button) const noexcept;
  bool drives_otherwise(const StickState& state, const LeverReading& reading) noexcept;
  void watch_full_force(glm::dvec2 moved, glm::dvec2 force) noexcept;
  bool is_stop_pressed(const LeverCounts& counts) noexcept;
  void damp_in_walls() noexcept;
  void send() noexcept;
  bool drives() const noexcept { return spec_.max_force.y > 0.0; }

  DeviceCalibration calibration_;
  PidDriver& driver_;
  DeviceSpec spec_;
  std::array<Axis, 2> axis_;          // select, shift
  glm::dmat2 coupling_, uncoupling_;  // force_coupling() and its inverse
  StickCommand command_;
  LeverWalls walls_;
  glm::dvec2 position_{0.0};           // [m] newest
  glm::dvec2 against_{0.0};            // [m] that the lever moved against nearly the full force, without a pause
  std::array<bool, 2> is_doubtful_{};  // in this push, the motors may make no force
  int doubtful_pushes_ = 0;            // in a row
  std::uint64_t session_;              // session of the last state
  bool halted_ = false;                // the session changed in this cycle
  ForceWatch watch_;
  StopButton own_stop_;
  StopButton& stop_;
};

}  // namespace gearshift::haptics
