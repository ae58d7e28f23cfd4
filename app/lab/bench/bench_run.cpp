#include "app/lab/bench/bench_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace gearshift::lab {

std::string format_value(double value) {
  return fmt::format("{:.4g}", value);
}

std::string format_goal(const BenchRow& row) {
  return row.goal ? fmt::format("{} {:g}", row.at_least ? ">=" : "<=", *row.goal) : "";
}

Verdict verdict_of(const BenchRow& row) noexcept {
  if (!row.goal || !row.measured) return Verdict::none;
  return meets_goal(row) ? Verdict::met : Verdict::missed;
}

bool is_open(const BenchRow& row) noexcept {
  return verdict_of(row) != Verdict::none && row.spread && row.spread->low < *row.goal && row.spread->high > *row.goal;
}

std::string format_verdict(const BenchRow& row) {
  static constexpr std::string_view kWords[] = {"", "met", "NOT MET"};
  return fmt::format("{}{}", kWords[static_cast<std::size_t>(verdict_of(row))], is_open(row) ? " (open)" : "");
}

std::string_view goal_direction(const BenchRow& row) {
  return !row.goal ? "" : row.at_least ? "at least" : "at most";
}

std::string_view design_row_name(const BenchRow& row) {
  const auto* found =
      std::find_if(kDesignRows.begin(), kDesignRows.end(), [&](const auto& r) { return r.key == row.design; });
  return found == kDesignRows.end() ? "" : found->name;
}

std::string format_spread(const std::optional<Quartiles>& spread) {
  return spread ? fmt::format("{:.4g} to {:.4g}", spread->low, spread->high) : "";
}

std::string format_change(const std::optional<SinceLast>& since) {
  if (!since) return "";
  const std::string ratio =
      std::isfinite(since->ratio) ? fmt::format("{:.3g} x", since->ratio) : fmt::format("was {:.4g}", since->value);
  return since->changed ? ratio + " *" : ratio;
}

std::string format_change(const MeasuredRow& measured) {
  const std::string value = format_change(measured.since), cost = format_change(measured.cost_since);
  return cost.empty() ? value : fmt::format("{}{}cost {}", value, value.empty() ? "" : ", ", cost);
}

std::optional<BenchRow> cost_row(const BenchRow& row) {
  if (!row.trade) return std::nullopt;
  const RelatedFigure& cost = row.trade->cost;
  BenchRow of_cost{row.family, row.name + " (cost)", cost.value, cost.unit, {}, false, {}};
  of_cost.measured = row.measured;
  of_cost.spread = cost.spread;
  return of_cost;
}

}  // namespace gearshift::lab
