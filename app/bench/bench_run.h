// A run of the bench: what was measured, when, where, and what the last full run there had of it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/bench/machine.h"
#include "app/bench/taken_elsewhere.h"
#include "tests/bench/bench.h"

namespace gearshift {

// The same row against the last full run on this machine.
struct SinceLast {
  std::string date, program, taken;  // of that run: taken as taken_words() says it, or empty
  double value = 0.0;                // then
  double ratio = 1.0;                // [1] now over then; not finite where then it was 0
  // By more than the spread: the quartiles then and now share nothing. Of a figure without spread: its first four digits.
  bool changed = false;
};

struct MeasuredRow {
  BenchRow row;
  std::optional<SinceLast> since = {};
  std::optional<SinceLast> cost_since = {};  // of the row's trade
};

// What a row's method costs, as a row of its own: "NAME (cost)". Nothing for a row without a trade.
std::optional<BenchRow> cost_row(const BenchRow& row);

struct BenchRun {
  std::string program, date;
  bool quick = false;
  Machine machine;
  std::optional<TakenElsewhere> taken = {};  // meanwhile
  std::vector<MeasuredRow> rows;
};

enum class Verdict { none, met, missed };  // none: no goal, or not measured
Verdict verdict_of(const BenchRow& row) noexcept;
bool is_open(const BenchRow& row) noexcept;  // the goal lies between the quartiles: the next run may say otherwise

std::string value_words(double value);                             // four digits
std::string goal_words(const BenchRow& row);                       // "<= 0.1"; empty without a goal
std::string verdict_words(const BenchRow& row);                    // "met", "NOT MET (open)"; empty without a goal
std::string_view direction_words(const BenchRow& row);             // "at most", "at least"; empty without a goal
std::string_view design_words(const BenchRow& row);                // name of the row of the design; empty without one
std::string spread_words(const std::optional<Quartiles>& spread);  // "180 to 195"; empty without
std::string since_words(const std::optional<SinceLast>& since);    // "1.03 x", " *" behind what changed
std::string since_words(const MeasuredRow& measured);              // of the value, and of the cost where there is one

}  // namespace gearshift
