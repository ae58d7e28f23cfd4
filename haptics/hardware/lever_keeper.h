// Keeps a stick open, on a thread of its own: opens it, prepares it, streams, and when it is gone waits for it to come
// back, at growing intervals (12 ms to 1 s). The haptic loop never notices but by readings that stay away.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "haptics/hardware/pid_driver.h"
#include "haptics/hid/hid_port.h"

namespace gearshift {

// A port to the device, or a HidError that says why not. Called on the keeper's thread.
using PortOpener = std::function<std::unique_ptr<HidPort>()>;

class LeverKeeper {
 public:
  // The driver must outlive it. tick_ns: the least between two outputs [ns].
  LeverKeeper(PidDriver& driver, PortOpener open, std::int64_t tick_ns);
  ~LeverKeeper();  // motors off, the device given back
  LeverKeeper(const LeverKeeper&) = delete;
  LeverKeeper& operator=(const LeverKeeper&) = delete;

  bool connected() const noexcept;            // prepared, and streaming
  std::optional<PidAbility> ability() const;  // of the device as it was last prepared
  // "... was unplugged", "... is back: its motors are off", a problem: one sentence, in order. What keeps it from being opened and
  // what it does wrong is told once, until it has worked again for a second; of one that failed nothing more.
  std::optional<std::string> take_news();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
