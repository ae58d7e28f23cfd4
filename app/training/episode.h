// Something that lasts: it begins, has gaps, ends, and is told once.
#pragma once

#include <algorithm>
#include <cmath>

#include "app/training/fault_rules.h"

namespace gearshift {

class Episode {
 public:
  // least: shorter ones are not told. most: told at the latest after this, though it goes on. [s]
  explicit Episode(double least, double most = 1e9) noexcept : least_(least), most_(most) {}

  // True in the one update in which it is told. A value that is no number counts as none.
  bool update(bool on, double value, double time, double dt) noexcept {
    gap_ = on ? 0.0 : gap_ + dt;
    if (on && !open_) {
      *this = Episode(least_, most_);
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

  // The same where the drive is over.
  bool finish() noexcept { return is_due(true); }

  bool is_open() const noexcept { return open_; }
  double begin() const noexcept { return begin_; }    // [s]
  double length() const noexcept { return length_; }  // [s] without its gaps
  double peak() const noexcept { return peak_; }
  double sum() const noexcept { return sum_; }  // integral of the value

 private:
  bool is_due(bool over) noexcept {
    const bool due = open_ && !told_ && length_ >= least_ && (over || length_ >= most_);
    told_ = told_ || due;
    if (over) open_ = false;
    return due;
  }

  double least_, most_;
  bool open_ = false, told_ = false;
  double begin_ = 0.0, length_ = 0.0, gap_ = 0.0, peak_ = 0.0, sum_ = 0.0;
};

}  // namespace gearshift
