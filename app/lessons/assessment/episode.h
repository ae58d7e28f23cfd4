// A condition that lasts for a while, may have short gaps, and is reported once.
#pragma once

#include <algorithm>
#include <cmath>

#include "app/lessons/assessment/error_rules.h"

namespace gearshift::lessons {

class Episode {
 public:
  // min_length: shorter episodes are not reported. max_length: an episode is reported at this length even if it
  // continues. [s]
  explicit Episode(double min_length, double max_length = 1e9) noexcept
      : min_length_(min_length), max_length_(max_length) {}

  // True in the one update in which the episode is to be reported. A value that is not finite counts as zero.
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

  // Call at the end of the drive. Returns true if an open episode is to be reported.
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
