// A force-feedback stick as a lever: PidDriver's counts and shares in metres and newtons, by its calibration.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "haptics/device/haptic_device.h"
#include "haptics/hardware/device_calibration.h"
#include "haptics/hardware/pid_driver.h"

namespace gearshift {

// One axis: metres at the knob, counts, and the shares by which the device counts deflections.
class LeverAxisMap {
 public:
  LeverAxisMap() = default;
  // logical range of the axis in the report [counts]
  LeverAxisMap(const LeverAxisCalibration& axis, const BitField& field) noexcept;

  double metres(double counts) const noexcept;  // straight on either side of the centre; beyond the stops, too
  double counts(double metres) const noexcept;
  double share(double metres) const noexcept;  // [1] -1 to 1 over the logical range, clamped

 private:
  double centre_ = 0.0, middle_ = 0.0, half_range_ = 1.0;  // [counts]
  double below_ = 1.0, above_ = 1.0;                       // [m] of a count, on the low and on the high side
};

class PidLever final : public HapticDevice {
 public:
  // The driver must outlive it. period [s] of the loop. Throws std::invalid_argument: no range, an axis that the stick
  // lacks, a delay beyond what the loop accounts for.
  PidLever(const DeviceCalibration& calibration, PidDriver& driver, double period);
  ~PidLever() override { driver_.release(); }
  PidLever(const PidLever&) = delete;
  PidLever& operator=(const PidLever&) = delete;

  const DeviceSpec& spec() const noexcept override { return spec_; }
  // Fresh with every report of the device. The force of the motors is what was sent, and what its own walls give back at
  // this depth: no such stick measures it. When the stick has come back, or the driver has cut its motors, one reading
  // says stop: what drove before drives on when a person has armed it.
  LeverReading read(std::int64_t now_ns) noexcept override;
  void switch_on() noexcept override { wish_.enabled = drives(); }  // told by the next write()
  void write(glm::dvec2 force) noexcept override;                   // without measured polarity: no force
  void hold_walls(const LeverWalls& walls) noexcept override;
  void release() noexcept override;

 private:
  struct Axis {
    LeverAxisMap map;
    std::size_t report = 0;   // among the report's axes
    std::size_t motor = 0;    // of the driver's two: X, Y
    double full_force = 0.0;  // [N] 0: it has no motor, or an unknown one
    double sign = 0.0;        // of a constant force
    double spring = 0.0;      // coefficient of the walls, with its sign; 0: it keeps none
    double damper = 0.0;      // the same of the damper in them
  };

  Axis make_axis(const LeverAxisCalibration& calibration, bool drives) const;
  double coefficient(PidEffect effect, int sign, double wanted, double strongest) const noexcept;
  glm::dvec2 motor_force(const PidSight& sight, glm::dvec2 position) const noexcept;
  bool has_button(const LeverCounts& counts, int button) const noexcept;
  bool stop_held(const LeverCounts& counts) noexcept;
  void damp_in_walls() noexcept;
  void tell() noexcept;
  bool drives() const noexcept { return spec_.max_force.x > 0.0 && spec_.max_force.y > 0.0; }

  DeviceCalibration calibration_;
  PidDriver& driver_;
  DeviceSpec spec_;
  std::array<Axis, 2> axis_;  // select, shift
  PidWish wish_;
  LeverWalls walls_;
  glm::dvec2 position_{0.0};    // [m] newest
  std::uint64_t session_;       // of the last sight
  bool halted_ = false;         // in this cycle: the session is new
  bool stop_was_free_ = false;  // a button that is held from the start is none
};

}  // namespace gearshift
