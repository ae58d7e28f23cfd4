// A port that leads straight to an emulated stick: no USB between. On the real clock by stream(), or tick by tick on any.
#pragma once

#include <atomic>
#include <mutex>

#include "haptics/hid/hid_port.h"
#include "tests/support/stick/emulated_stick.h"

namespace gearshift {

// One tick: the stick moves on to now, what it reports goes to the stream, what the stream wants sent goes to it. Throws
// HidError where it does not take it, or has not answered for 250 ms.
void tick_stick(EmulatedStick& stick, const StreamConfig& config, HidStream& stream, std::int64_t now_ns);

class StickPort : public HidPort {
 public:
  // plugged: false while it is not there: everything throws HidGone then. All of them must outlive the port; the mutex
  // guards the stick while stream() runs on another thread.
  StickPort(EmulatedStick& stick, std::mutex& mutex, const std::atomic<bool>& plugged);

  const HidIdentity& identity() const noexcept override;
  const std::vector<std::uint8_t>& report_descriptor() const noexcept override;
  HidBytes get_feature(std::uint8_t id, std::size_t size) override;
  void set_feature(const HidBytes& report) override;
  void send(const HidBytes& report) override;
  void stream(const StreamConfig& config, HidStream& stream) override;  // CLOCK_MONOTONIC

 private:
  std::unique_lock<std::mutex> begin_transfer();

  EmulatedStick& stick_;
  std::mutex& mutex_;
  const std::atomic<bool>& plugged_;
  HidIdentity identity_;
};

}  // namespace gearshift
