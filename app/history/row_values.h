// Inside this room: figures, flags and choices as they stand in a row. The file is not believed: what is read can be.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/training/shift_record.h"

namespace gearshift {

// What a figure can be, whoever wrote it: finite and below 1e9; what is not finite is 0, as what was never measured.
void bind_figure(SQLite::Statement& statement, int place, double value);
double figure_in(const SQLite::Statement& row, int place);

bool flag_in(const SQLite::Statement& row, int place);

template <class Enum>
Enum choice_in(const SQLite::Statement& row, int place, Enum last) {
  const std::int64_t value = row.getColumn(place).getInt64();
  return static_cast<Enum>(std::clamp<std::int64_t>(value, 0, static_cast<std::int64_t>(last)));
}

std::string figure_names();            // of a shift: ", begin_s, end_s, ..."
std::string marks(std::size_t count);  // "?, ?, ?"

std::string steps_text(const std::vector<ShiftStep>& steps);
std::vector<ShiftStep> steps_of(const std::string& text);

}  // namespace gearshift
