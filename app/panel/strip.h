// A value against time, kept as the least and the greatest of each column of a plot: what a peak of one sample shows,
// whatever the zoom. Columns lie on the grid of absolute time, so they do not shimmer while the plot moves on.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace gearshift {

struct StripColumn {
  double least = 0.0, most = 0.0;
  double first = 0.0, last = 0.0;  // in time
  std::uint32_t count = 0;         // of samples; 0: empty
};

class Strip {
 public:
  Strip(double span, int columns);  // [s] > 0; >= 1

  // Amortised O(1). A time before the last one is another run: all is forgotten. What is not finite is left out.
  void push(double time, double value);

  void set_columns(int columns);  // anew from the samples of the span, where the number changes
  int columns() const noexcept { return static_cast<int>(columns_.size()); }
  const StripColumn& column(int from_oldest) const noexcept;  // 0 to columns() - 1

  StripColumn extent() const noexcept;  // of all columns: least, most and count

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
  std::vector<StripColumn> columns_;  // ring by place
  std::int64_t newest_ = 0;           // place of the last sample, [columns] since time 0
  std::deque<Sample> samples_;        // of the span
};

}  // namespace gearshift
