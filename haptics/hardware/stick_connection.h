// Maintains the connection to a stick on a thread of its own: opens and prepares the stick, streams, and reconnects
// after an unplug, retrying at growing intervals (12 ms to 1 s). The haptic loop only notices that no fresh readings
// arrive.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "haptics/hardware/pid_driver.h"
#include "haptics/hid/hid_port.h"

namespace gearshift::haptics {

// Returns a port to the device or throws HidError with the reason. Called on the connection's thread.
using PortOpener = std::function<std::unique_ptr<HidPort>()>;

class StickConnection {
 public:
  // The driver must outlive the connection. `tick_ns`: minimum interval between outputs [ns].
  StickConnection(PidDriver& driver, PortOpener open, std::int64_t tick_ns);
  ~StickConnection();  // switches the motors off and closes the device
  StickConnection(const StickConnection&) = delete;
  StickConnection& operator=(const StickConnection&) = delete;

  bool connected() const noexcept;            // prepared and streaming
  std::optional<PidAbility> ability() const;  // capabilities of the device when last prepared; empty before
  // Returns the oldest message (unplugged, reconnected, or a problem) as one sentence, or an empty value if there is
  // none. A problem of the connection is reported again only after the stick has streamed for a second or was
  // unplugged. After a failure while streaming, further failures are not reported until the stick is connected again.
  std::optional<std::string> take_message();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::haptics
