#include <fmt/format.h>

#include "app/base/csv.h"
#include "app/lab/bench/bench_files.h"

namespace gearshift::lab {
namespace {

std::string related_field(const BenchRow& row) {
  std::string text;
  for (const RelatedFigure& more : row.related)
    text += fmt::format("{}{} = {} {}", text.empty() ? "" : "; ", more.what, more.value, more.unit);
  return base::csv_field(text);
}

// CSV fields: contest, method, cost, cost_unit, error, error_unit, chosen.
std::string trade_fields(const std::optional<Trade>& trade) {
  if (!trade) return ",,,,,,";
  return fmt::format("{},{},{},{},{},{},{}", base::csv_field(trade->contest), base::csv_field(trade->method),
                     trade->cost.value, base::csv_field(trade->cost.unit), trade->error.value,
                     base::csv_field(trade->error.unit), trade->chosen ? "yes" : "no");
}

std::string row_fields(const BenchRun& run, const MeasuredRow& measured) {
  const BenchRow& row = measured.row;
  const auto number = [](bool there, double value) { return there ? fmt::format("{}", value) : std::string(); };
  const Quartiles spread = row.spread.value_or(Quartiles{});
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", row.family, base::csv_field(row.name),
      number(row.measured, row.value), base::csv_field(row.unit), number(row.goal.has_value(), row.goal.value_or(0.0)),
      goal_direction(row), format_verdict(row), design_row_name(row), base::csv_field(row.note), related_field(row),
      number(row.spread.has_value(), spread.low), number(row.spread.has_value(), spread.high), trade_fields(row.trade),
      number(measured.since.has_value(), measured.since ? measured.since->value : 0.0), base::csv_field(run.program),
      run.date);
}

}  // namespace

std::string bench_csv(const BenchRun& run) {
  std::string text =
      "family,what,value,unit,goal,goal_is,verdict,design,note,beside,quartile_low,quartile_high,contest,method,cost,"
      "cost_unit,error,error_unit,chosen,last,program,date\n";
  for (const MeasuredRow& measured : run.rows) text += row_fields(run, measured) + "\n";
  return text;
}

}  // namespace gearshift::lab
