// Constructs bench runs without measuring anything.
#pragma once

#include "app/lab/bench/bench_run.h"

namespace gearshift::test {

inline lab::BenchRow plain_row(const std::string& family, const std::string& name, double value) {
  return {family, name, value, "ns", {}, false, {}};
}

inline lab::BenchRow trade_row(const std::string& method, double cost, double error, bool chosen = false) {
  lab::BenchRow row{"walk", method, error, "mm", {}, false, "by hand"};
  row.trade = lab::Trade{"walks", method, {"cost", cost, "ns"}, {"error", error, "mm"}, chosen};
  return row;
}

inline lab::BenchRun make_run(const std::vector<lab::BenchRow>& rows) {
  lab::BenchRun run{
      .program = "gearshift 9.9",
      .date = "2026-01-02T03:04:05Z",
      .quick = false,
      .machine = {.cpu = "Abacus", .cores = 2, .gpu = "", .host = "desk", .system = "", .compiler = "", .build = ""},
      .rows = {}};
  for (const lab::BenchRow& row : rows) run.rows.push_back({row});
  return run;
}

}  // namespace gearshift::test
