// Inside this room: what SQLite's problems are, in words.
#pragma once

#include <SQLiteCpp/Exception.h>

#include <string>

struct sqlite3;

namespace gearshift {

inline constexpr const char* kDeleted = "what this belongs to was deleted by another program";

int short_code(const SQLite::Exception& problem) noexcept;  // SQLITE_CANTOPEN, ...

// Of a row that is not there (any more) to hang on; other broken rules are this program's own mistakes.
bool is_gone(const SQLite::Exception& problem) noexcept;
bool is_busy(const SQLite::Exception& problem) noexcept;
bool is_full(const SQLite::Exception& problem, sqlite3* database) noexcept;  // the disk; database: may be null

std::string reason_of(const SQLite::Exception& problem, sqlite3* database);  // half a sentence

}  // namespace gearshift
