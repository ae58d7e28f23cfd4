// The time stamp counter of x86-64 processors; on other processors the steady clock. Reading it takes much less time
// than a haptic cycle.
#pragma once

#include <chrono>
#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace gearshift::lab {

inline std::uint64_t ticks() noexcept {
#if defined(__x86_64__)
  return __rdtsc();
#else
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

// The counter's rate, measured once over 50 ms against the steady clock.
inline double ticks_per_ns() {
  static const double rate = [] {
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t first = ticks();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(50)) continue;
    const auto ns =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - start).count();
    return static_cast<double>(ticks() - first) / static_cast<double>(ns);
  }();
  return rate;
}

}  // namespace gearshift::lab
