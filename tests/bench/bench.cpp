#include "tests/bench/bench.h"

#include <algorithm>
#include <cmath>

namespace gearshift {

bool meets_goal(const BenchRow& row) noexcept {
  if (!row.measured || !row.goal) return true;
  return row.at_least ? row.value >= *row.goal : row.value <= *row.goal;
}

double quantile(std::vector<double>& sample, double q) {
  if (sample.empty()) return 0.0;
  std::sort(sample.begin(), sample.end());
  const double rank = q * static_cast<double>(sample.size() - 1);
  return sample[static_cast<std::size_t>(std::lround(rank))];
}

}  // namespace gearshift
