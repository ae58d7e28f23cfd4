// Detects a condition that lasts for some time, tolerates short gaps, and reports each episode once.
#pragma once

#include <algorithm>
#include <cmath>

namespace gearshift::lessons {

// An episode continues through gaps shorter than this.
inline constexpr double kEpisodeGap = 0.3;  // [s] engineering value

class Episode {
 public:
  // `min_length` [s]: shorter episodes are not reported. `max_length` [s]: an episode is reported at this length even
  // if the condition continues.
  explicit Episode(double min_length, double max_length = 1e9) noexcept
      : min_length_(min_length), max_length_(max_length) {}

  // Returns true once per episode, when the episode should be reported. A value that is not finite counts as zero.
  bool update(bool on, double value, double time, double dt) noexcept {
    gap_ = on ? 0.0 : gap_ + dt;
    if (on && !open_) {
      *this = Episode(min_length_, max_length_);
      open_ = true;
      begin_ = time;
    }
    if (on) length_ += dt;
    if (on && std::isfinite(value)) {
      sum_ += value * dt;
      peak_ = std::max(peak_, value);
    }
    return is_due(gap_ >= kEpisodeGap);
  }

  // Call at the end of the drive. Returns true if an open episode should be reported.
  bool finish() noexcept { return is_due(true); }

  bool is_open() const noexcept { return open_; }
  double begin() const noexcept { return begin_; }    // [s]
  double length() const noexcept { return length_; }  // [s] without gaps
  double peak() const noexcept { return peak_; }
  double sum() const noexcept { return sum_; }  // integral of the value over time

 private:
  bool is_due(bool over) noexcept {
    const bool due = open_ && !reported_ && length_ >= min_length_ && (over || length_ >= max_length_);
    reported_ = reported_ || due;
    if (over) open_ = false;
    return due;
  }

  double min_length_, max_length_;
  bool open_ = false, reported_ = false;
  double begin_ = 0.0, length_ = 0.0, gap_ = 0.0, peak_ = 0.0, sum_ = 0.0;
};

}  // namespace gearshift::lessons
