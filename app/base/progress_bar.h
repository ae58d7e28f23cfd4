// A progress bar on stderr, shown only if stderr is a terminal. It appears after one second and is erased at the end.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "app/base/console.h"

namespace gearshift::base {

class ProgressBar {
 public:
  ProgressBar() = default;
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // `label`: name of the current part of the work. `fraction`: finished part of the work, 0 to 1. Cheap enough to be
  // called every cycle.
  void show(std::string_view label, double fraction) {
    if (!is_terminal_) return;
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    drawn_ = true;
    const double done = std::clamp(fraction, 0.0, 1.0);
    const std::string bar(static_cast<std::size_t>(kWidth * done), '=');
    print_to(stderr, fmt::format("\r{:<14} [{:{}}] {:3.0f} %", label, bar, kWidth, 100.0 * done));
    std::fflush(stderr);
  }

  // Erases the bar. Call this before printing anything else.
  void clear() {
    if (drawn_) print_to(stderr, fmt::format("\r{:{}}\r", "", kWidth + 24));
    drawn_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kWidth = 40;  // [characters]

  Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
  bool is_terminal_ = isatty(STDERR_FILENO) == 1;
  bool drawn_ = false;
};

}  // namespace gearshift::base
