// The clock of every time in the loop, its trace and the sticks: CLOCK_MONOTONIC, which is steady_clock here, too.
#pragma once

#include <time.h>

#include <cstdint>

namespace gearshift {

inline constexpr std::int64_t kSecondNs = 1'000'000'000;  // [ns]

inline std::int64_t monotonic_ns() noexcept {  // [ns] real-time safe
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecondNs + now.tv_nsec;
}

}  // namespace gearshift
