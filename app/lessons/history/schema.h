// The tables of the history, and the scripts that bring an older file up to date.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace gearshift::lessons {

// Application ids, stored in the file header.
inline constexpr int kApplicationId = 0x47534c48;     // "GSLH"
inline constexpr int kOldApplicationId = 0x47534849;  // "GSHI": written until 0.1.0, no longer read

inline constexpr int kSchemaVersion = 5;

// The words of an SQL dialect that the tables of learners need.
struct SqlDialect {
  std::string_view key;      // type of a row's number
  std::string_view integer;  // 64 bits
  std::string_view real;     // double precision
};
inline constexpr SqlDialect kSqlite{"INTEGER PRIMARY KEY AUTOINCREMENT", "INTEGER", "REAL"};

// The tables of learners, sessions, runs, shifts, driving errors and comments in this dialect.
std::string learner_tables(const SqlDialect& dialect);

// All tables of the newest version of the file, as SQL.
std::string schema();

// Script i upgrades a file from version i + 1 to i + 2. All needed scripts run in one
// transaction, with foreign keys off, so that recreating a table does not delete dependent rows.
std::array<std::string, kSchemaVersion - 1> upgrades();

}  // namespace gearshift::lessons
