// Private to this folder: classifies SQLite errors and describes them.
#pragma once

#include <SQLiteCpp/Exception.h>

#include <string>

struct sqlite3;

namespace gearshift::lessons {

inline constexpr const char* kDeleted = "the learner, run or comment was deleted by another program";

int primary_code(const SQLite::Exception& problem) noexcept;  // SQLITE_CANTOPEN, ...

// True if a referenced row does not exist (any more). Other violated constraints are bugs in this program.
bool is_missing_parent(const SQLite::Exception& problem) noexcept;
bool is_busy(const SQLite::Exception& problem) noexcept;
// True if the disk is full. `database` may be null.
bool is_full(const SQLite::Exception& problem, sqlite3* database) noexcept;

std::string reason_of(const SQLite::Exception& problem, sqlite3* database);  // reason as a clause without a full stop

}  // namespace gearshift::lessons
