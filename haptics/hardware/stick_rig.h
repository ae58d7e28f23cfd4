// How a measurement looks at a stick and drives it: tick by tick, with every refusal that all measurements share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>

#include "haptics/hardware/pid_driver.h"

namespace gearshift {

// Why a measurement means nothing, in one sentence.
class CalibrationRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Blocks until the next tick, of about a millisecond, and says what time it is [ns] on the driver's clock.
using CalibrationTick = std::function<std::int64_t()>;

// For the length of one measurement; motors off at its end.
class StickRig {
 public:
  StickRig(PidDriver& driver, const CalibrationTick& tick);
  ~StickRig() { driver_.release(); }
  StickRig(const StickRig&) = delete;
  StickRig& operator=(const StickRig&) = delete;

  struct Look {
    std::int64_t now_ns = 0;
    bool fresh = false;  // it brought a new reading
    PidSight sight;
  };

  // One tick under that wish. Throws CalibrationRefused: the stick was lost, or says nothing.
  const Look& step(const PidWish& wish = {});
  const Look& look() const noexcept { return look_; }
  double position(std::size_t axis) const noexcept {  // [counts] newest
    return static_cast<double>(look_.sight.counts.axis[axis]);
  }
  double range(std::size_t axis) const noexcept;  // [counts] that the report can say
  double share(std::size_t axis) const noexcept;  // [1] -1 to 1, as the device counts deflections

  // Until the axis stands still under that wish. Its mean place then [counts]. Throws CalibrationRefused: it never does.
  double rest(std::size_t axis, const PidWish& wish = {});

  // Throws CalibrationRefused where the axis is further from there than a measurement may move it.
  void watch_runaway(std::size_t axis, double from) const;

 private:
  PidDriver& driver_;
  const CalibrationTick& tick_;
  std::uint64_t session_;
  std::int64_t heard_ns_ = 0;  // a reading
  bool heard_ = false;
  Look look_;
};

}  // namespace gearshift
