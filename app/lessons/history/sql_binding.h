// Private to this folder: the columns of a record (each_field() in app/lessons/assessment), bound and read. The file is
// not trusted, so every value that is read is forced into its valid range.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/shift_record.h"
#include "app/lessons/history/schema.h"

namespace gearshift::lessons {

// Numbers are limited to 1e9 in magnitude. A value that is not finite becomes 0, which also stands for a value that was
// never measured.
double stored_figure(double value) noexcept;

std::string stored_date(std::string date);  // empty if it is no date of format_utc()

template <class T>
concept Number = std::floating_point<T> || std::integral<T>;  // flags are integers, too
template <class T>
concept StoredAsNumber = std::is_enum_v<T> && !std::same_as<T, ErrorKind>;

// Type of a column in the schema.
template <Number T>
std::string column_type(const SqlDialect& dialect, const std::optional<T>&) {
  return std::string(std::floating_point<T> ? dialect.real : dialect.integer);
}
template <Number T>
std::string column_type(const SqlDialect& dialect, const T&) {
  return column_type(dialect, std::optional<T>()) + " NOT NULL";
}
template <StoredAsNumber T>
std::string column_type(const SqlDialect& dialect, const T&) {
  return column_type(dialect, 0);
}
std::string column_type(const SqlDialect&, const auto&) {
  return "TEXT NOT NULL";
}

void bind_value(SQLite::Statement& statement, int index, const std::string& value);
void bind_value(SQLite::Statement& statement, int index, const std::vector<ShiftStep>& steps);
void bind_value(SQLite::Statement& statement, int index, ErrorKind kind);
void bind_value(SQLite::Statement& statement, int index, StoredAsNumber auto value) {
  statement.bind(index, static_cast<int>(value));
}
void bind_value(SQLite::Statement& statement, int index, Number auto value) {
  if constexpr (std::integral<decltype(value)>)
    statement.bind(index, static_cast<std::int64_t>(value));
  else
    statement.bind(index, stored_figure(value));
}
template <Number T>
void bind_value(SQLite::Statement& statement, int index, const std::optional<T>& value) {
  value ? bind_value(statement, index, *value) : statement.bind(index);
}

void read_value(const SQLite::Statement& row, int index, std::string& value);
void read_value(const SQLite::Statement& row, int index, std::vector<ShiftStep>& steps);
void read_value(const SQLite::Statement& row, int index, ErrorKind& kind);  // unknown: unchanged
void read_value(const SQLite::Statement& row, int index, StoredAsNumber auto& value) {
  using Enum = std::remove_reference_t<decltype(value)>;
  const std::int64_t number = row.getColumn(index).getInt64();
  value = static_cast<Enum>(std::clamp<std::int64_t>(number, 0, static_cast<std::int64_t>(last_value(Enum()))));
}
template <Number T>
void read_value(const SQLite::Statement& row, int index, T& value) {
  if constexpr (std::same_as<T, bool>)
    value = row.getColumn(index).getInt64() != 0;
  else
    value = static_cast<T>(stored_figure(row.getColumn(index).getDouble()));
}
template <Number T>
void read_value(const SQLite::Statement& row, int index, std::optional<T>& value) {
  if (row.getColumn(index).isNull())
    value.reset();
  else
    read_value(row, index, value.emplace());
}

template <class Record>
std::string column_definitions(const SqlDialect& dialect) {  // "begin_s REAL NOT NULL, end_s ..."
  std::string text;
  each_field(Record(), [&](const RecordField& field, const auto& value) {
    text += (text.empty() ? "" : ",\n  ") + std::string(field.name) + " " + column_type(dialect, value);
  });
  return text;
}

// The names of the columns, each followed by `after`: "begin_s, end_s, ..."
template <class Record>
std::string column_names(const std::string& after = "") {
  std::string text;
  each_field(Record(), [&](const RecordField& field, const auto&) {
    text += (text.empty() ? "" : ", ") + std::string(field.name) + after;
  });
  return text;
}

// "?, ?, ..." for the columns of a record and `more` other columns.
template <class Record>
std::string placeholders(std::size_t more) {
  std::string text;
  each_field(Record(), [&](const RecordField&, const auto&) { text += text.empty() ? "?" : ", ?"; });
  for (std::size_t i = 0; i < more; ++i) text += ", ?";
  return text;
}

// Binds or reads the columns of a record, the first at `index`. Returns the index after the last one.
template <class Record>
int bind_record(SQLite::Statement& statement, int index, const Record& record) {
  each_field(record, [&](const RecordField&, const auto& value) { bind_value(statement, index++, value); });
  return index;
}
template <class Record>
int read_record(const SQLite::Statement& row, int index, Record& record) {
  each_field(record, [&](const RecordField&, auto& value) { read_value(row, index++, value); });
  return index;
}

}  // namespace gearshift::lessons
