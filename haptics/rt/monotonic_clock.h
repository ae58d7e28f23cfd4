// The clock used by the loop, its trace and the stick driver: CLOCK_MONOTONIC, the same clock as
// std::chrono::steady_clock on Linux.
#pragma once

#include <time.h>

#include <cstdint>

namespace gearshift::haptics {

inline constexpr std::int64_t kSecondNs = 1'000'000'000;  // [ns]

inline std::int64_t monotonic_ns() noexcept {  // [ns] real-time safe
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecondNs + now.tv_nsec;
}

}  // namespace gearshift::haptics
