// A run of the bench: measured rows, date, machine, and the comparison with the previous full run on that machine.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lab/bench/cpu_contention.h"
#include "app/lab/bench/machine.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {

// Comparison of a row with the previous full run on this machine.
struct SinceLast {
  std::string date, program, contention;  // of the last run; contention: text of format_contention(), or empty
  double value = 0.0;                     // value in the last run
  double ratio = 1.0;                     // [1] value now divided by value in the last run; infinite if that was 0
  // True if the quartile ranges of the two runs do not overlap. Without quartiles: true if the first four digits
  // differ.
  bool changed = false;
};

struct MeasuredRow {
  BenchRow row;
  std::optional<SinceLast> since = {};
  std::optional<SinceLast> cost_since = {};  // comparison of the cost in row.trade
};

// Returns the cost of the row's method as a separate row, "NAME (cost)". Empty if the row has no cost
// (BenchRow::trade).
std::optional<BenchRow> cost_row(const BenchRow& row);

struct BenchRun {
  std::string program, date;
  bool quick = false;
  Machine machine;
  std::optional<CpuContention> contention = {};  // during the run
  std::vector<MeasuredRow> rows;
};

enum class Verdict { none, met, missed };  // none: the row has no goal or was not measured
Verdict verdict_of(const BenchRow& row) noexcept;
bool is_open(const BenchRow& row) noexcept;  // true if the goal is between the quartiles, so a new run may differ

std::string format_value(double value);                 // four digits
std::string format_goal(const BenchRow& row);           // "<= 0.1"; empty if the row has no goal
std::string format_verdict(const BenchRow& row);        // "met", "NOT MET (open)"; empty without a goal
std::string_view goal_direction(const BenchRow& row);   // "at most", "at least"; empty without a goal
std::string_view design_row_name(const BenchRow& row);  // name of the design requirement that the row checks; or empty
std::string format_spread(const std::optional<Quartiles>& spread);  // "180 to 195"; empty if there are no quartiles
std::string format_change(const std::optional<SinceLast>& since);   // "1.03 x"; ends with " *" if the value changed
std::string format_change(const MeasuredRow& measured);             // change of the value and, if measured, of the cost

}  // namespace gearshift::lab
