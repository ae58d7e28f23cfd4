#include "app/history/row_values.h"

#include <cmath>

#include "app/training/shift_fields.h"

namespace gearshift {
namespace {

constexpr double kLargest = 1e9;  // [1] of any figure, in its unit; fits an int [engineering value]

double figure(double value) noexcept {
  return std::isfinite(value) ? std::clamp(value, -kLargest, kLargest) : 0.0;
}

}  // namespace

void bind_figure(SQLite::Statement& statement, int place, double value) {
  statement.bind(place, figure(value));
}

double figure_in(const SQLite::Statement& row, int place) {
  return figure(row.getColumn(place).getDouble());
}

bool flag_in(const SQLite::Statement& row, int place) {
  return row.getColumn(place).getInt64() != 0;
}

std::string marks(std::size_t count) {
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

std::string steps_text(const std::vector<ShiftStep>& steps) {
  std::string text;
  for (const ShiftStep step : steps) text += static_cast<char>('0' + static_cast<int>(step));
  return text;
}

std::vector<ShiftStep> steps_of(const std::string& text) {
  std::vector<ShiftStep> steps;
  for (const char c : text) {
    if (c >= '0' && c <= '5') steps.push_back(static_cast<ShiftStep>(c - '0'));
  }
  return steps;
}

}  // namespace gearshift
