// An emulated stick that is opened on the real clock, and the hand of its user.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "app/runtime/devices/stick_lever.h"
#include "tests/support/stick/stick_port.h"

namespace gearshift::test {

// A hand whose target position can be set by another thread.
class PersonsHand final : public haptics::HandDriver {
 public:
  haptics::HandTarget next(double, glm::dvec2) noexcept override {
    haptics::HandTarget target;
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

// The calibration of a default EmulatedStick (SideWinder family). The shift axis counts down toward the front. A
// positive constant force comes from the right on the select axis and from the user on the shift axis (PID 1.0).
inline haptics::DeviceCalibration sidewinder_calibration() {
  haptics::DeviceCalibration known;
  known.vendor = 0x045e;
  known.product = 0x001b;
  known.name = "SideWinder";
  const EmulatedStickConfig truth;
  known.select = {
      0x30, -512.0, -0.5, 511.0, 2.0 * truth.half_travel, truth.full_force, -1, 0, 0.0, haptics::kPaperAxisX};
  known.shift = {0x31, 511.0, -0.5, -512.0, 2.0 * truth.half_travel, truth.full_force, 1, 0, 0.0, haptics::kPaperAxisY};
  known.select.constant_limit = known.shift.constant_limit = 1.0;
  known.timing = {0.001, 0.001, 0.0, 0.001};
  return known;
}

struct HeldStick {
  PersonsHand hand;
  EmulatedStick stick;
  std::mutex mutex;  // guards the stick
  std::atomic<bool> plugged{true};
  std::shared_ptr<runtime::StickLever> lever;

  HeldStick()
      : HeldStick(
            runtime::KnownStick{sidewinder_calibration(), EmulatedStick(config(), idle_hand()).report_descriptor()}) {}
  explicit HeldStick(const runtime::KnownStick& known, const EmulatedStickConfig& emulated = config())
      : stick(emulated, hand) {
    stick.logs = false;
    lever = std::make_shared<runtime::StickLever>(known, [this]() -> std::unique_ptr<haptics::HidPort> {
      if (!plugged) throw haptics::HidDisconnected("The stick is not plugged in");
      return std::make_unique<StickPort>(stick, mutex, plugged);
    });
  }
  ~HeldStick() { lever.reset(); }

  double force() {  // [N] magnitude of the motors' force
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

  static EmulatedStickConfig config() {
    EmulatedStickConfig config;
    config.lever.hand = haptics::kGripHand;
    return config;
  }

 private:
  static haptics::HandDriver& idle_hand() {
    static haptics::IdleHand hand;
    return hand;
  }
};

}  // namespace gearshift::test
