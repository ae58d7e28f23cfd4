// Private to this folder: classifies SQLite errors and describes them.
#pragma once

#include <SQLiteCpp/Exception.h>

#include <string>

struct sqlite3;

namespace gearshift::lessons {

inline constexpr const char* kDeleted = "its learner, run or comment was deleted by another program";

int primary_code(const SQLite::Exception& problem) noexcept;  // SQLITE_CANTOPEN, ...

// True if the referenced row does not exist (any more); other violated constraints are bugs of this program.
bool is_missing_parent(const SQLite::Exception& problem) noexcept;
bool is_busy(const SQLite::Exception& problem) noexcept;
bool is_full(const SQLite::Exception& problem, sqlite3* database) noexcept;  // disk full; database may be null

std::string reason_of(const SQLite::Exception& problem, sqlite3* database);  // a clause without a full stop

}  // namespace gearshift::lessons
