// The wire to one HID device. One thread uses it: it may wait there, the haptic thread never sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "haptics/hid/hid_bytes.h"
#include "haptics/hid/hid_error.h"

namespace gearshift {

struct HidIdentity {
  std::uint16_t vendor = 0, product = 0;
  std::string serial;       // empty: it tells none
  std::string maker, name;  // as it calls itself, printable; may be empty
  std::string place;        // where it is plugged in: "1-1.2"; the same after a re-plug there
};

// What happens while reports stream. All of it is called on the port's thread, and none of it waits.
class HidStream {
 public:
  virtual ~HidStream() = default;
  virtual void on_input(std::span<const std::uint8_t> report,
                        std::int64_t time_ns) noexcept = 0;  // ID first; CLOCK_MONOTONIC
  // What is to be sent next; size 0: nothing now. Called when the pipe is free: at once after wake_fd() was written to,
  // and at least every tick_ns.
  virtual HidBytes next_output(std::int64_t now_ns) noexcept = 0;
  virtual void on_sent(std::int64_t time_ns) noexcept = 0;  // the last output has arrived
  virtual bool should_end() const noexcept = 0;             // asked at every wake-up
};

struct StreamConfig {
  int wake_fd = -1;                     // an eventfd: written to when next_output() has something new; -1: none
  std::int64_t tick_ns = 1'000'000;     // [ns] the least between two outputs, and the most between two looks
  std::uint8_t lever_report = 0;        // ID of the input report that must not fall silent
  std::int64_t silence_ns = 8'000'000;  // [ns] after so long without one the device is asked for it (GET_REPORT): a
                                        // stick that reports changes alone is not dead while it stands still
};

class HidPort {
 public:
  virtual ~HidPort() = default;
  virtual const HidIdentity& identity() const noexcept = 0;
  virtual const std::vector<std::uint8_t>& report_descriptor() const noexcept = 0;

  // Over the control pipe, or the interrupt pipe where it is one. They wait, 250 ms at most. Throw HidGone, HidError with
  // one sentence.
  virtual HidBytes get_feature(std::uint8_t id, std::size_t size) = 0;  // size as asked, ID included; may be shorter
  virtual void set_feature(const HidBytes& report) = 0;
  virtual void send(const HidBytes& report) = 0;

  // Until should_end(), or the device is gone (HidGone) or does not answer any more (HidError).
  virtual void stream(const StreamConfig& config, HidStream& stream) = 0;
};

}  // namespace gearshift
