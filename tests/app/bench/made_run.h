// A run of the bench made by hand: nothing is measured.
#pragma once

#include "app/bench/bench_run.h"

namespace gearshift {

inline BenchRow plain_row(const std::string& family, const std::string& name, double value) {
  return {family, name, value, "ns", {}, false, {}};
}

inline BenchRow trade_row(const std::string& method, double cost, double error, bool chosen = false) {
  BenchRow row{"walk", method, error, "mm", {}, false, "by hand"};
  row.trade = Trade{"walks", method, {"cost", cost, "ns"}, {"error", error, "mm"}, chosen};
  return row;
}

inline BenchRun made_run(const std::vector<BenchRow>& rows) {
  BenchRun run{
      .program = "gearshift 9.9",
      .date = "2026-01-02T03:04:05Z",
      .quick = false,
      .machine = {.cpu = "Abacus", .cores = 2, .gpu = "", .host = "desk", .system = "", .compiler = "", .build = ""},
      .rows = {}};
  for (const BenchRow& row : rows) run.rows.push_back({row});
  return run;
}

}  // namespace gearshift
