#include "app/lab/bench/rows/bench.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace gearshift::lab {

bool meets_goal(const BenchRow& row) noexcept {
  if (!row.measured || !row.goal) return true;
  return row.at_least ? row.value >= *row.goal : row.value <= *row.goal;
}

double quantile(std::vector<double>& sample, double q) {
  if (sample.empty()) return 0.0;
  std::sort(sample.begin(), sample.end());
  const double rank = q * static_cast<double>(sample.size() - 1), below = std::floor(rank);
  const auto at = static_cast<std::size_t>(below);
  if (rank == below) return sample[at];  // no interpolation, because a value may be infinite
  return sample[at] + (rank - below) * (sample[at + 1] - sample[at]);
}

Timed timed(std::vector<double>& sample) {
  const double median = quantile(sample, 0.5);
  if (sample.size() < 2) return {median, {}};
  return {median, Quartiles{quantile(sample, 0.25), quantile(sample, 0.75)}};
}

BenchRow answers_design(Design design, BenchRow row) {
  row.design = design;
  return row;
}

BenchRow with_spread(const std::optional<Quartiles>& spread, BenchRow row) {
  row.spread = spread;
  return row;
}

std::vector<BenchRow> run_family(const NamedFamily& family, const BenchOptions& options) {
  std::vector<BenchRow> rows = family.run(options);
  std::set<Design> answered, claimed(family.answers.begin(), family.answers.end());
  for (const BenchRow& row : rows) answered.insert(row.design);
  answered.erase(Design::none);
  if (answered != claimed)
    throw std::logic_error("bench family " + std::string(family.name) +
                           " does not answer exactly the design rows that it claims");
  return rows;
}

std::vector<BenchRow> unmeasured_family(const NamedFamily& family, const std::string& why) {
  std::vector<BenchRow> rows;
  for (const DesignRow& required : kDesignRows) {
    if (std::find(family.answers.begin(), family.answers.end(), required.key) == family.answers.end()) continue;
    rows.push_back(
        answers_design(required.key, {std::string(family.name), std::string(required.name), 0.0, "", {}, false, why}));
  }
  if (rows.empty()) rows.push_back({std::string(family.name), "whole family", 0.0, "", {}, false, why});
  for (BenchRow& row : rows) row.measured = false;
  return rows;
}

}  // namespace gearshift::lab
