// A port that connects directly to an emulated stick, without USB. StickPort::stream() runs in real time; tick_stick()
// runs a single tick at any time.
#pragma once

#include <atomic>
#include <mutex>

#include "haptics/hid/hid_port.h"
#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

// Advances the stick to now_ns, delivers its reports to the stream, and sends the stream's output. Throws HidError if
// the output is not accepted, or if the stick has not answered for 250 ms.
void tick_stick(EmulatedStick& stick, const haptics::StreamConfig& config, haptics::HidStream& stream,
                std::int64_t now_ns);

class StickPort : public haptics::HidPort {
 public:
  // While `plugged` is false, get_feature(), set_feature(), send() and stream() throw HidDisconnected. All arguments
  // must outlive the port. `mutex` guards the stick while stream() runs on another thread.
  StickPort(EmulatedStick& stick, std::mutex& mutex, const std::atomic<bool>& plugged);

  const haptics::HidIdentity& identity() const noexcept override;
  const std::vector<std::uint8_t>& report_descriptor() const noexcept override;
  haptics::HidBytes get_feature(std::uint8_t id, std::size_t size) override;
  void set_feature(const haptics::HidBytes& report) override;
  void send(const haptics::HidBytes& report) override;
  void stream(const haptics::StreamConfig& config, haptics::HidStream& stream) override;  // CLOCK_MONOTONIC

 private:
  std::unique_lock<std::mutex> begin_transfer();

  EmulatedStick& stick_;
  std::mutex& mutex_;
  const std::atomic<bool>& plugged_;
  haptics::HidIdentity identity_;
};

}  // namespace gearshift::test
