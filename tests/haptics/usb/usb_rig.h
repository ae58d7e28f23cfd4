// A plain joystick on an emulated bus, and how the tests wait for what happens on other threads.
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

namespace gearshift {

// False: it has not come true in 10 s.
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

inline HidIdentity plain_identity() {
  HidIdentity identity;
  identity.vendor = 0x1209;
  identity.product = 0x0001;
  return identity;
}

inline HidBytes report_of(std::initializer_list<std::uint8_t> bytes) {
  HidBytes report;
  for (const std::uint8_t byte : bytes) report.bytes[report.size++] = byte;
  return report;
}

// The sentence of what was thrown; empty: nothing was.
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

  // Of the gadget, while the bus does not call it.
  template <class Look>
  auto see(Look look) {
    const std::lock_guard<std::mutex> lock(usb.mutex());
    return look(gadget);
  }
  std::unique_ptr<HidPort> open() { return open_usb_hid(plain_identity()); }
};

// A stream on a thread of its own.
class Streaming {
 public:
  Streaming(HidPort& port, const StreamConfig& config, RecordingStream& stream)
      : stream_(stream), thread_([this, &port, config] { run(port, config); }) {}
  ~Streaming() { end(); }
  Streaming(const Streaming&) = delete;
  Streaming& operator=(const Streaming&) = delete;

  void end() {
    stream_.end();
    if (thread_.joinable()) thread_.join();
  }
  // It ends by itself, or is made to.
  void join() {
    becomes_true([this] { return has_ended(); });
    end();
  }
  bool has_ended() const { return ended_; }
  // Once it has ended.
  bool gone() const { return gone_; }
  const std::string& error() const { return error_; }

 private:
  void run(HidPort& port, const StreamConfig& config) {
    try {
      port.stream(config, stream_);
    } catch (const HidGone& error) {
      gone_ = true;
      error_ = error.what();
    } catch (const HidError& error) {
      error_ = error.what();
    }
    ended_ = true;
  }

  RecordingStream& stream_;
  std::atomic<bool> ended_{false};
  bool gone_ = false;
  std::string error_;
  std::thread thread_;
};

}  // namespace gearshift
