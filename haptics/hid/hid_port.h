// Connection to one HID device. Only one thread uses it, and never the haptic thread, because calls may block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "haptics/hid/hid_bytes.h"
#include "haptics/hid/hid_error.h"

namespace gearshift::haptics {

struct HidIdentity {
  std::uint16_t vendor = 0, product = 0;
  std::string serial;       // empty: the device has none
  std::string maker, name;  // reported by the device, made printable; may be empty
  std::string place;        // USB port path, such as "1-1.2"; the same after replugging into the same port
};

// Callbacks of a stream. All are called on the port's thread and must not block.
class HidStream {
 public:
  virtual ~HidStream() = default;
  virtual void on_input(std::span<const std::uint8_t> report,
                        std::int64_t time_ns) noexcept = 0;  // ID first; CLOCK_MONOTONIC
  // Returns the next report to send, or an empty report (size 0) for none. Called when the pipe is free: immediately
  // after a write to `wake_fd`, and at least every `tick_ns`.
  virtual HidBytes next_output(std::int64_t now_ns) noexcept = 0;
  virtual void on_sent(std::int64_t time_ns) noexcept = 0;  // the last output has arrived
  virtual bool should_end() const noexcept = 0;             // checked at every wake-up
};

struct StreamConfig {
  int wake_fd = -1;                  // eventfd that is written when next_output() has a new report; -1: none
  std::int64_t tick_ns = 1'000'000;  // [ns] minimum time between outputs, maximum time between next_output() calls
  std::uint8_t lever_report = 0;     // ID of the input report with the lever's position
  // [ns] If no lever report arrives for this time, the port requests one with GET_REPORT, because a stick that reports
  // only changes is silent while the lever is still.
  std::int64_t silence_ns = 8'000'000;
};

class HidPort {
 public:
  virtual ~HidPort() = default;
  virtual const HidIdentity& identity() const noexcept = 0;
  virtual const std::vector<std::uint8_t>& report_descriptor() const noexcept = 0;

  // Synchronous transfers on the control pipe; send() uses the interrupt OUT pipe if there is one. Each transfer blocks
  // for at most 250 ms. A failed transfer throws HidDisconnected or HidError with one sentence.
  virtual HidBytes get_feature(std::uint8_t id,
                               std::size_t size) = 0;  // size includes the ID; the result may be shorter
  virtual void set_feature(const HidBytes& report) = 0;
  virtual void send(const HidBytes& report) = 0;

  // Streams until should_end() returns true. Throws HidDisconnected if the device is disconnected, HidError if the
  // device no longer answers.
  virtual void stream(const StreamConfig& config, HidStream& stream) = 0;
};

}  // namespace gearshift::haptics
