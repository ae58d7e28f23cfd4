// A plain joystick on an emulated bus, and helpers that wait for events on other threads.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "haptics/usb/usb_hid.h"
#include "tests/haptics/usb/plain_gadget.h"
#include "tests/haptics/usb/recording_stream.h"
#include "tests/support/usb/mock_usb.h"

namespace gearshift::test {

// Waits for the condition; returns false if it is not true within 10 s.
template <class Condition>
bool becomes_true(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

inline void rest(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

inline haptics::HidIdentity plain_identity() {
  haptics::HidIdentity identity;
  identity.vendor = 0x1209;
  identity.product = 0x0001;
  return identity;
}

inline haptics::HidBytes report_of(std::initializer_list<std::uint8_t> bytes) {
  haptics::HidBytes report;
  for (const std::uint8_t byte : bytes) report.bytes[report.size++] = byte;
  return report;
}

// Returns the message of the exception that `action` throws; empty if it throws none.
template <class Error, class Action>
std::string sentence_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

struct UsbRig {
  PlainGadget gadget;
  MockUsb usb;

  // Calls `query_gadget` with the gadget, while the bus is locked.
  template <class Query>
  auto query(Query query_gadget) {
    const std::lock_guard<std::mutex> lock(usb.mutex());
    return query_gadget(gadget);
  }
  std::unique_ptr<haptics::HidPort> open() { return haptics::open_usb_hid(plain_identity()); }
};

// Runs a stream on its own thread until the stream ends.
class Streaming {
 public:
  Streaming(haptics::HidPort& port, const haptics::StreamConfig& config, RecordingStream& stream)
      : stream_(stream), thread_([this, &port, config] { run(port, config); }) {}
  ~Streaming() { end(); }
  Streaming(const Streaming&) = delete;
  Streaming& operator=(const Streaming&) = delete;

  void end() {
    stream_.end();
    if (thread_.joinable()) thread_.join();
  }
  // Waits up to 10 s for the stream to end by itself, then ends it.
  void join() {
    becomes_true([this] { return has_ended(); });
    end();
  }
  bool has_ended() const { return ended_; }
  // Valid only after the stream has ended.
  bool was_disconnected() const { return disconnected_; }
  const std::string& error() const { return error_; }

 private:
  void run(haptics::HidPort& port, const haptics::StreamConfig& config) {
    try {
      port.stream(config, stream_);
    } catch (const haptics::HidDisconnected& error) {
      disconnected_ = true;
      error_ = error.what();
    } catch (const haptics::HidError& error) {
      error_ = error.what();
    }
    ended_ = true;
  }

  RecordingStream& stream_;
  std::atomic<bool> ended_{false};
  bool disconnected_ = false;
  std::string error_;
  std::thread thread_;
};

}  // namespace gearshift::test
