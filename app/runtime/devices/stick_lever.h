// A force-feedback stick that stays open, and the lever device that it provides to haptic loops.
//
// One stick outlives many loops: each change of gate, car or preset starts a new loop, and the stick stays open in
// between with its motors off. An unplugged stick is waited for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/runtime/devices/known_stick.h"
#include "haptics/device/haptic_device.h"
#include "haptics/hardware/pid_driver.h"
#include "haptics/hardware/stick_connection.h"

namespace gearshift::runtime {

inline constexpr std::int64_t kTickNs = 1'000'000;  // [ns] frame of full-speed USB: a pipe carries one report per frame

class StickLever {
 public:
  // Opens the stick, and reopens it after an unplug, on its own thread. Its reports must be the same as when it was
  // calibrated. Throws HidError or std::invalid_argument with one sentence.
  StickLever(const KnownStick& stick, haptics::PortOpener open);
  ~StickLever();  // motors off, device released

  // The lever for a loop of that period [s]; creating it moves nothing. Only one may exist at a time, and it must not
  // outlive the stick. Throws std::invalid_argument if the stick responds too slowly for a loop of that rate.
  std::unique_ptr<haptics::HapticDevice> lever(double period);
  // Like lever(), but not connected to the stick: to check limits while another lever is in use.
  std::unique_ptr<haptics::HapticDevice> detached_lever(double period);

  const haptics::DeviceCalibration& calibration() const noexcept { return stick_.calibration; }
  std::string name() const { return stick_name(identity_of(stick_.calibration)); }
  double answer_time() const noexcept { return haptics::answer_time(stick_.calibration.timing); }  // [s] worst case
  bool connected() const noexcept { return keeper_.connected(); }

  // Returns what happened to the stick, one sentence per call, in order: missing abilities, unplugged, connected again,
  // faults.
  std::optional<std::string> take_message();

 private:
  KnownStick stick_;
  haptics::PidDriver idle_;  // not connected to any device
  haptics::PidDriver driver_;
  haptics::StickConnection keeper_;
  std::size_t notes_reported_ = 0;  // number of ability().notes reported
};

}  // namespace gearshift::runtime
