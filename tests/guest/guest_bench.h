// Common code of the test programs in the guest: waiting for a condition, and sticks plugged into the kernel.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "haptics/device/hand.h"
#include "tests/guest/attached_stick.h"
#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

inline constexpr StickFamily kFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy};

// Waits up to `seconds` until the condition holds. Returns false if it still does not hold.
template <class Condition>
bool becomes_true(Condition condition, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

// An emulated stick plugged into the kernel.
struct PluggedStick {
  PluggedStick(const EmulatedStickConfig& config, haptics::HandDriver& hand) : stick(config, hand) {
    stick.logs = false;
    plug_in();
  }
  void plug_in() { attached.emplace(stick, mutex); }
  void pull_out() { attached.reset(); }

  int vendor() const { return stick.device_descriptor()[8] | stick.device_descriptor()[9] << 8; }
  int product() const { return stick.device_descriptor()[10] | stick.device_descriptor()[11] << 8; }

  // Calls the function with the stick, while no other thread uses the stick.
  template <class Function>
  auto with_stick(Function function) {
    const std::lock_guard<std::mutex> lock(mutex);
    return function(stick);
  }

  EmulatedStick stick;
  std::mutex mutex;
  std::optional<AttachedStick> attached;  // destroyed first
};

}  // namespace gearshift::test
