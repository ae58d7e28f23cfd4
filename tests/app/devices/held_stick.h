// An emulated stick that is held open, on the real clock, and the hand of the person at it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "app/devices/stick_lever.h"
#include "tests/support/stick/stick_port.h"

namespace gearshift {

// A grip that is led from another thread.
class PersonsHand final : public HandDriver {
 public:
  HandTarget next(double, glm::dvec2) noexcept override {
    HandTarget target;
    target.position = {x_.load(), y_.load()};
    return target;
  }
  void go(glm::dvec2 to) noexcept {
    x_ = to.x;
    y_ = to.y;
  }

 private:
  std::atomic<double> x_{0.0}, y_{0.0};  // [m]
};

// What a calibration finds of an EmulatedStick of the SideWinder's family as it is by default: forward counts down, and
// a positive constant force comes from the right and from the user (PID 1.0).
inline DeviceCalibration sidewinder_calibration() {
  DeviceCalibration known;
  known.vendor = 0x045e;
  known.product = 0x001b;
  known.name = "SideWinder";
  const EmulatedStickConfig truth;
  known.select = {0x30, -512.0, -0.5, 511.0, 2.0 * truth.half_travel, truth.full_force, -1, 0, 0.0, kPaperAxisX};
  known.shift = {0x31, 511.0, -0.5, -512.0, 2.0 * truth.half_travel, truth.full_force, 1, 0, 0.0, kPaperAxisY};
  known.timing = {0.001, 0.001, 0.0, 0.001};
  return known;
}

struct HeldStick {
  PersonsHand hand;
  EmulatedStick stick{config(), hand};
  std::mutex mutex;  // of the stick
  std::atomic<bool> plugged{true};
  std::shared_ptr<StickLever> lever;

  HeldStick()
      : HeldStick(KnownStick{sidewinder_calibration(), EmulatedStick(config(), nobody()).report_descriptor()}) {}
  explicit HeldStick(const KnownStick& known) {
    stick.logs = false;
    lever = std::make_shared<StickLever>(known, [this]() -> std::unique_ptr<HidPort> {
      if (!plugged) throw HidGone("The stick is not plugged in");
      return std::make_unique<StickPort>(stick, mutex, plugged);
    });
  }
  ~HeldStick() { lever.reset(); }

  double force() {  // [N] of the motors
    const std::lock_guard lock(mutex);
    return std::hypot(stick.force().x, stick.force().y);
  }
  bool actuators_on() {
    const std::lock_guard lock(mutex);
    return stick.actuators_on();
  }
  void unplug() {
    plugged = false;
    const std::lock_guard lock(mutex);
    stick.unplug();
  }
  void plug_in() { plugged = true; }

 private:
  static EmulatedStickConfig config() {
    EmulatedStickConfig config;
    config.lever.hand = kGripHand;
    return config;
  }
  static HandDriver& nobody() {
    static RestingHand hand;
    return hand;
  }
};

}  // namespace gearshift
