// A force-feedback stick that stays open, and the lever device that the stick provides to haptic loops.
//
// One stick outlives many loops: each change of gate, car or preset starts a new loop, and the stick stays open in
// between with its motors off. If the stick is unplugged, this class waits until it is plugged in again.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/runtime/devices/known_stick.h"
#include "haptics/device/haptic_device.h"
#include "haptics/hardware/pid_driver.h"
#include "haptics/hardware/pid_lever.h"
#include "haptics/hardware/stick_connection.h"

namespace gearshift::runtime {

inline constexpr std::int64_t kTickNs = 1'000'000;  // [ns] a full-speed USB frame, in which a pipe carries one report

class StickLever {
 public:
  // Opens the stick, and reopens it on a separate thread when it has been replugged. The stick's reports must be the
  // same as when it was calibrated. Throws HidError or std::invalid_argument with a one-sentence message.
  StickLever(const KnownStick& stick, haptics::PortOpener open);
  ~StickLever();  // switches the motors off and releases the device

  // Returns the lever for a loop with this period [s] without moving the stick. Only one such lever may exist at a
  // time, and it must not outlive this object. Throws std::invalid_argument if the stick responds too slowly for a loop
  // at this rate.
  std::unique_ptr<haptics::HapticDevice> lever(double period);
  // Like lever(), but not connected to the stick: for checking limits while the connected lever is in use.
  std::unique_ptr<haptics::HapticDevice> detached_lever(double period);

  const haptics::DeviceCalibration& calibration() const noexcept { return stick_.calibration; }
  std::string name() const { return stick_name(identity_of(stick_.calibration)); }
  std::string id() const { return stick_id(identity_of(stick_.calibration)); }                     // "046d:c24f"
  double answer_time() const noexcept { return haptics::answer_time(stick_.calibration.timing); }  // [s] worst case
  bool connected() const noexcept { return connection_.connected(); }

  // Returns the next message about the stick: a missing ability, an unplug, a reconnection or a fault. Each message is
  // one sentence and is returned only once. Empty: no message.
  std::optional<std::string> take_message();

 private:
  KnownStick stick_;
  haptics::PidDriver idle_;  // not connected to any device
  haptics::PidDriver driver_;
  haptics::StickConnection connection_;
  haptics::StopButton stop_;
  std::string unmeasured_;          // what the calibration, from an older version or left out, does not contain
  std::size_t notes_reported_ = 0;  // number of PidAbility::notes that take_message() has returned
};

}  // namespace gearshift::runtime
