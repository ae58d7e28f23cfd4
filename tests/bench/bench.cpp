#include "tests/bench/bench.h"

#include <algorithm>
#include <cmath>

namespace gearshift {

bool meets_goal(const BenchRow& row) noexcept {
  if (!row.measured || !row.goal) return true;
  return row.at_least ? row.value >= *row.goal : row.value <= *row.goal;
}

const std::vector<NamedFamily>& bench_families() {
  static const std::vector<NamedFamily> families{
      {"cycle", bench_cycle},         {"headless", bench_headless}, {"plant", bench_plant},
      {"feel", bench_feel},           {"contact", bench_contact},   {"energy", bench_energy},
      {"delivered", bench_delivered}, {"boundary", bench_boundary}, {"methods", bench_methods},
      {"hard", bench_hard},           {"faults", bench_faults},     {"intent", bench_intent},
      {"jitter", bench_jitter}};
  return families;
}

double quantile(std::vector<double>& sample, double q) {
  if (sample.empty()) return 0.0;
  std::sort(sample.begin(), sample.end());
  const double rank = q * static_cast<double>(sample.size() - 1);
  return sample[static_cast<std::size_t>(std::lround(rank))];
}

}  // namespace gearshift
