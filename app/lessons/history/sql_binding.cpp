#include "app/lessons/history/sql_binding.h"

#include <cmath>

#include "app/lessons/assessment/shift_fields.h"

namespace gearshift::lessons {
namespace {

constexpr double kMaxFigure = 1e9;  // largest stored magnitude, in the number's unit; fits an int (engineering value)

double figure(double value) noexcept {
  return std::isfinite(value) ? std::clamp(value, -kMaxFigure, kMaxFigure) : 0.0;
}

}  // namespace

void bind_figure(SQLite::Statement& statement, int index, double value) {
  statement.bind(index, figure(value));
}

double figure_in(const SQLite::Statement& row, int index) {
  return figure(row.getColumn(index).getDouble());
}

bool flag_in(const SQLite::Statement& row, int index) {
  return row.getColumn(index).getInt64() != 0;
}

std::string placeholders(std::size_t count) {
  std::string text = "?";
  for (std::size_t i = 1; i < count; ++i) text += ", ?";
  return text;
}

std::string figure_names() {
  std::string names;
  const ShiftRecord none;
  each_figure(none, [&](const char* name, const auto&) { names += std::string(", ") + name; });
  return names;
}

std::string format_steps(const std::vector<ShiftStep>& steps) {
  std::string text;
  for (const ShiftStep step : steps) text += static_cast<char>('0' + static_cast<int>(step));
  return text;
}

std::vector<ShiftStep> parse_steps(const std::string& text) {
  std::vector<ShiftStep> steps;
  for (const char c : text) {
    if (c >= '0' && c <= '5') steps.push_back(static_cast<ShiftStep>(c - '0'));
  }
  return steps;
}

}  // namespace gearshift::lessons
