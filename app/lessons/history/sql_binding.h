// Private to this folder: binds and reads numbers, flags and enumerations of a row. The file is not trusted, so every
// value that is read is forced into its valid range.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/lessons/assessment/shift_record.h"

namespace gearshift::lessons {

// bind_figure() and figure_in() limit numbers to 1e9 in magnitude. A value that is not finite becomes 0, which also
// stands for a value that was never measured.
void bind_figure(SQLite::Statement& statement, int index, double value);
double figure_in(const SQLite::Statement& row, int index);

bool flag_in(const SQLite::Statement& row, int index);

template <class Enum>
Enum enum_in(const SQLite::Statement& row, int index, Enum last) {
  const std::int64_t value = row.getColumn(index).getInt64();
  return static_cast<Enum>(std::clamp<std::int64_t>(value, 0, static_cast<std::int64_t>(last)));
}

std::string figure_names();                   // column names of a shift: ", begin_s, end_s, ..."
std::string placeholders(std::size_t count);  // "?, ?, ?"

std::string format_steps(const std::vector<ShiftStep>& steps);
std::vector<ShiftStep> parse_steps(const std::string& text);

}  // namespace gearshift::lessons
