#include "app/bench/bench_run.h"

#include <cmath>

#include <fmt/format.h>

namespace gearshift {

std::string value_words(double value) {
  return fmt::format("{:.4g}", value);
}

std::string goal_words(const BenchRow& row) {
  return row.goal ? fmt::format("{} {:g}", row.at_least ? ">=" : "<=", *row.goal) : "";
}

std::string_view verdict_words(const BenchRow& row) {
  if (!row.goal || !row.measured) return "";
  return meets_goal(row) ? "met" : "NOT MET";
}

std::string spread_words(const std::optional<Quartiles>& spread) {
  return spread ? fmt::format("{:.4g} to {:.4g}", spread->low, spread->high) : "";
}

std::string since_words(const std::optional<SinceLast>& since) {
  if (!since) return "";
  const std::string ratio =
      std::isfinite(since->ratio) ? fmt::format("{:.3g} x", since->ratio) : fmt::format("was {:.4g}", since->value);
  return since->changed ? ratio + " *" : ratio;
}

}  // namespace gearshift
