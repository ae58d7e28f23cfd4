#include <algorithm>

#include <fmt/format.h>

#include "app/bench/bench_files.h"

namespace gearshift {
namespace {

std::string with_unit(const Beside& figure) {
  return value_words(figure.value) + (figure.unit.empty() ? "" : " " + figure.unit);
}

std::string row_note(const BenchRow& row) {
  std::string note = row.note;
  const auto add = [&](const std::string& more) { note += (note.empty() ? "" : "; ") + more; };
  if (row.spread) add("quartiles " + spread_words(row.spread));
  for (const Beside& more : row.beside) add(more.what + " " + with_unit(more));
  return note;
}

}  // namespace

std::string bench_table(const BenchRun& run) {
  const bool compared = std::any_of(run.rows.begin(), run.rows.end(), [](const auto& r) { return r.since; });
  const auto last = [&](const std::string& words) { return compared ? fmt::format(" {:<24}", words) : ""; };
  std::string table = fmt::format("{:<9} {:<58} {:>12} {:<20} {:>10}{}  {}\n", "family", "what", "value", "unit",
                                  "goal", last(" since last"), "");
  for (const MeasuredRow& measured : run.rows) {
    const BenchRow& row = measured.row;
    table += fmt::format("{:<9} {:<58} {:>12} {:<20} {:>10}{}  {:<14} {}\n", row.family, row.name,
                         row.measured ? value_words(row.value) : "-", row.unit, goal_words(row),
                         last(" " + since_words(measured)), verdict_words(row), row_note(row));
  }
  if (run.taken) table += fmt::format("of the processors meanwhile: {}\n", taken_words(*run.taken));
  return table;
}

}  // namespace gearshift
