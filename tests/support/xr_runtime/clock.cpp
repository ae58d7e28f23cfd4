// Display time. XrTime is CLOCK_MONOTONIC; the script's clock is the time since the first xrBeginSession.
#include <algorithm>
#include <cmath>
#include <thread>

#include "tests/support/xr_runtime/state.h"

namespace gearshift::xr_test {
namespace {

void sleep_until(XrTime time) {
  const timespec until{.tv_sec = time / 1'000'000'000, .tv_nsec = time % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

std::int64_t elapsed_periods(const State& s, XrTime time) {
  return (time - s.begin) / period(s);
}

}  // namespace

XrTime monotonic_now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

XrDuration period(const State& s) {
  return std::llround(s.control.script.period * 1e9);
}

double seconds(const State& s, XrTime time) {
  return s.begin == 0 ? 0.0 : static_cast<double>(time - s.begin) * 1e-9;
}

XrTime display_time(const State& s, std::int64_t step) {
  return s.begin + std::llround(static_cast<double>(step) * s.control.script.period * 1e9);
}

XrTime now(const State& s) {
  if (s.begin == 0 || s.control.script.pacing == Pacing::real) return monotonic_now();
  return display_time(s, std::max<std::int64_t>(s.next_step - 1, 0));
}

std::int64_t next_display_period(State& s, XrTime last) {
  if (s.control.script.pacing == Pacing::real) {
    const std::int64_t free = elapsed_periods(s, monotonic_now()) + 1;
    // A frame must begin one period before its display time. Periods for which this is already too late count as
    // dropped.
    if (last != 0 && free > s.next_step) s.control.record.dropped += static_cast<std::uint64_t>(free - s.next_step);
    s.next_step = std::max(free, s.next_step);
    sleep_until(display_time(s, s.next_step - 1));
  }
  return s.next_step++;
}

void stall_periods(State& s, int periods) {
  s.control.record.dropped += static_cast<std::uint64_t>(periods);
  s.next_step += periods;
}

}  // namespace gearshift::xr_test
