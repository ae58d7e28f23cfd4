#include <algorithm>

#include <fmt/format.h>

#include "app/lab/bench/bench_files.h"

namespace gearshift::lab {
namespace {

std::string with_unit(const RelatedFigure& figure) {
  return format_value(figure.value) + (figure.unit.empty() ? "" : " " + figure.unit);
}

std::string row_note(const BenchRow& row) {
  std::string note = row.note;
  const auto add = [&](const std::string& more) { note += (note.empty() ? "" : "; ") + more; };
  if (row.spread) add("quartiles " + format_spread(row.spread));
  for (const RelatedFigure& more : row.related) add(more.what + " " + with_unit(more));
  return note;
}

}  // namespace

std::string bench_table(const BenchRun& run) {
  const bool compared = std::any_of(run.rows.begin(), run.rows.end(), [](const auto& r) { return r.since; });
  const auto last = [&](const std::string& text) { return compared ? fmt::format(" {:<24}", text) : ""; };
  std::string table = fmt::format("{:<9} {:<58} {:>12} {:<20} {:>10}{}  {}\n", "family", "what", "value", "unit",
                                  "goal", last(" since last"), "");
  for (const MeasuredRow& measured : run.rows) {
    const BenchRow& row = measured.row;
    table += fmt::format("{:<9} {:<58} {:>12} {:<20} {:>10}{}  {:<14} {}\n", row.family, row.name,
                         row.measured ? format_value(row.value) : "-", row.unit, format_goal(row),
                         last(" " + format_change(measured)), format_verdict(row), row_note(row));
  }
  if (run.contention) table += fmt::format("CPU time used by others: {}\n", format_contention(*run.contention));
  return table;
}

}  // namespace gearshift::lab
