#include "app/lessons/history/sql_binding.h"

#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "app/lessons/history/utc_time.h"

namespace gearshift::lessons {
namespace {

constexpr double kMaxFigure = 1e9;  // largest stored magnitude, in the number's unit; fits an int (engineering value)

}  // namespace

double stored_figure(double value) noexcept {
  return std::isfinite(value) ? std::clamp(value, -kMaxFigure, kMaxFigure) : 0.0;
}

void bind_value(SQLite::Statement& statement, int index, const std::string& value) {
  statement.bind(index, value);
}

void bind_value(SQLite::Statement& statement, int index, ErrorKind kind) {
  statement.bind(index, std::string(to_string(kind)));
}

void bind_value(SQLite::Statement& statement, int index, const std::vector<ShiftStep>& steps) {
  statement.bind(index, format_steps(steps));
}

std::string stored_date(std::string date) {
  return parse_utc(date) ? std::move(date) : std::string();
}

void read_value(const SQLite::Statement& row, int index, std::string& value) {
  value = row.getColumn(index).getString();
}

void read_value(const SQLite::Statement& row, int index, ErrorKind& kind) {
  kind = error_kind_of(row.getColumn(index).getString()).value_or(kind);
}

// Skips names that are no steps.
void read_value(const SQLite::Statement& row, int index, std::vector<ShiftStep>& steps) {
  steps.clear();
  std::istringstream names(row.getColumn(index).getString());
  for (std::string name; names >> name;) {
    const auto found = std::find(std::begin(kShiftStepNames), std::end(kShiftStepNames), name);
    if (found != std::end(kShiftStepNames)) steps.push_back(static_cast<ShiftStep>(found - kShiftStepNames));
  }
}

}  // namespace gearshift::lessons
