// Drives and observes a stick during a calibration measurement, tick by tick, with the checks common to all
// measurements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>

#include "haptics/hardware/pid_driver.h"

namespace gearshift::haptics {

// Thrown if a measurement is not valid. The message states the reason in one sentence.
class CalibrationRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Thrown if the stick's effects do not act as commanded, so that repeating the measurement would not help.
class EffectsRefused : public CalibrationRefused {
 public:
  using CalibrationRefused::CalibrationRefused;
};

// Thrown if the lever moves further than a measurement may move it.
class Runaway : public CalibrationRefused {
 public:
  using CalibrationRefused::CalibrationRefused;
};

// Blocks until the next tick, about every millisecond, and returns the time on the driver's clock [ns].
using CalibrationTick = std::function<std::int64_t()>;

// One measurement; the destructor switches the motors off.
class StickRig {
 public:
  StickRig(PidDriver& driver, const CalibrationTick& tick);
  ~StickRig() { driver_.release(); }
  StickRig(const StickRig&) = delete;
  StickRig& operator=(const StickRig&) = delete;

  struct Tick {
    std::int64_t now_ns = 0;
    bool fresh = false;  // this tick brought a new reading
    StickState state;
  };

  // Sends the command for one tick. Throws CalibrationRefused if the stick was disconnected or sends no readings.
  const Tick& step(const StickCommand& command = {});
  const Tick& latest() const noexcept { return latest_; }
  double position(std::size_t axis) const noexcept {  // [counts] newest
    return static_cast<double>(latest_.state.counts.axis[axis]);
  }
  double range(std::size_t axis) const noexcept;       // [counts] width of the axis's logical range
  double deflection(std::size_t axis) const noexcept;  // [1] -1 to 1, from end to end of the logical range

  // Repeats the command until the axis is still and returns its mean position [counts]; `also`: another axis that must
  // be still, too. Throws CalibrationRefused if they do not come to rest.
  double rest(std::size_t axis, const StickCommand& command = {}) { return rest(axis, command, axis); }
  double rest(std::size_t axis, const StickCommand& command, std::size_t also);

  // Throws Runaway if the axis is further from `from` [counts] than a measurement may move it.
  void watch_runaway(std::size_t axis, double from) const;

 private:
  PidDriver& driver_;
  const CalibrationTick& tick_;
  std::uint64_t session_;
  std::int64_t last_reading_ns_ = 0;
  bool has_reading_ = false;
  Tick latest_;
};

}  // namespace gearshift::haptics
