// A value against time, reduced to the minimum and maximum per plot column, so that even a peak of a single sample is
// visible at any zoom. The columns lie on a fixed time grid, so the curve does not flicker while the plot scrolls.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace gearshift::ui {

struct StripColumn {
  double min = 0.0, max = 0.0;
  double first = 0.0, last = 0.0;  // oldest and newest value in the column
  std::uint32_t count = 0;         // number of samples in the column
};

class Strip {
 public:
  Strip(double span, int columns);  // span [s] > 0; columns >= 1

  // Takes amortised O(1) time. A time before that of the previous value clears the strip first. Non-finite values are
  // ignored.
  void push(double time, double value);

  void set_columns(int columns);  // rebuilds the columns if their number changes
  int columns() const noexcept { return static_cast<int>(columns_.size()); }
  const StripColumn& column(int from_oldest) const noexcept;  // from_oldest: 0 (oldest column) to columns() - 1

  StripColumn extent() const noexcept;  // all columns combined into one; `first` and `last` are meaningless

  double span() const noexcept { return span_; }

 private:
  struct Sample {
    double time, value;
  };
  std::int64_t place(double time) const noexcept;
  void add(const Sample& sample);
  void clear_columns();
  StripColumn& slot(std::int64_t place) noexcept;

  double span_;
  std::vector<StripColumn> columns_;  // ring buffer indexed by time
  std::int64_t newest_ = 0;           // [columns] time of the newest sample, counted in columns from time 0
  std::deque<Sample> samples_;        // samples in the last `span` seconds
};

}  // namespace gearshift::ui
