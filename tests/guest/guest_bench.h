// What the programs in the guest share: waiting for the kernel, and the hands on the sticks.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "haptics/device/hand.h"
#include "tests/guest/attached_stick.h"
#include "tests/support/stick/emulated_stick.h"

namespace gearshift {

inline constexpr StickFamily kFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy};

// False: it has not come true in so many seconds.
template <class What>
bool comes_true(What what, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!what()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// A stick that is plugged into the kernel.
struct PluggedStick {
  PluggedStick(const EmulatedStickConfig& config, HandDriver& hand) : stick(config, hand) {
    stick.logs = false;
    plug_in();
  }
  void plug_in() { attached.emplace(stick, mutex); }
  void pull_out() { attached.reset(); }

  int vendor() const { return stick.device_descriptor()[8] | stick.device_descriptor()[9] << 8; }
  int product() const { return stick.device_descriptor()[10] | stick.device_descriptor()[11] << 8; }

  // The stick, while nothing moves it.
  template <class Look>
  auto see(Look look) {
    const std::lock_guard<std::mutex> lock(mutex);
    return look(stick);
  }

  EmulatedStick stick;
  std::mutex mutex;
  std::optional<AttachedStick> attached;  // goes first
};

}  // namespace gearshift
