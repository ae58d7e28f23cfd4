// A force-feedback stick that is held open, and the lever that the haptic loop sees of it.
//
// One stick outlives many loops: another gate, car or preset is another loop, and the stick stays open between them with
// its motors off. Where it is unplugged it is waited for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/devices/known_stick.h"
#include "haptics/device/haptic_device.h"
#include "haptics/hardware/lever_keeper.h"
#include "haptics/hardware/pid_driver.h"

namespace gearshift {

inline constexpr std::int64_t kTickNs = 1'000'000;  // [ns] a frame of full-speed USB: a pipe carries one report in it

class StickLever {
 public:
  // Opens it from now on, on a thread of its own. It must report as it did when it was calibrated. Throws HidError,
  // std::invalid_argument with one sentence.
  StickLever(const KnownStick& stick, PortOpener open);
  ~StickLever();  // motors off, the device given back

  // For a loop of that period [s]; nothing moves by it. One at a time: the one before is gone, and none outlives the stick.
  // Throws std::invalid_argument: slower than a loop of that rate can account for.
  std::unique_ptr<HapticDevice> lever(double period);
  // What lever() would be, but tied to nothing: to ask what would be admitted while another one is driven.
  std::unique_ptr<HapticDevice> stand_in(double period);

  const DeviceCalibration& calibration() const noexcept { return stick_.calibration; }
  std::string name() const { return stick_name(identity_of(stick_.calibration)); }
  double answer_time() const noexcept { return gearshift::answer_time(stick_.calibration.timing); }  // [s] worst
  bool connected() const noexcept { return keeper_.connected(); }

  // What happened to it, one sentence each, in order: what it cannot do, gone, back, what it does wrong.
  std::optional<std::string> take_news();

 private:
  KnownStick stick_;
  PidDriver idle_;  // that no device streams to
  PidDriver driver_;
  LeverKeeper keeper_;
  std::size_t notes_told_ = 0;  // of its ability
};

}  // namespace gearshift
