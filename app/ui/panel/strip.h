// A value against time, reduced to the minimum and maximum per plot column, so that even a one-sample peak is visible
// at any zoom. Columns lie on a grid of absolute time, so they do not shimmer while the plot scrolls.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace gearshift::ui {

struct StripColumn {
  double min = 0.0, max = 0.0;
  double first = 0.0, last = 0.0;  // oldest and newest value
  std::uint32_t count = 0;         // number of samples; 0: empty
};

class Strip {
 public:
  Strip(double span, int columns);  // [s] > 0; >= 1

  // Amortised O(1). A time before the last one starts a new run and clears the strip. Non-finite values are ignored.
  void push(double time, double value);

  void set_columns(int columns);  // rebuilds the columns if their number changes
  int columns() const noexcept { return static_cast<int>(columns_.size()); }
  const StripColumn& column(int from_oldest) const noexcept;  // 0 to columns() - 1

  StripColumn extent() const noexcept;  // over all columns; first and last are not meaningful

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
  std::int64_t newest_ = 0;           // time of the last sample in [columns] since time 0
  std::deque<Sample> samples_;        // within the span
};

}  // namespace gearshift::ui
