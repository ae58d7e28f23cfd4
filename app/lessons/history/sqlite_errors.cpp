#include "app/lessons/history/sqlite_errors.h"

#include <sqlite3.h>

#include <cerrno>

namespace gearshift::lessons {
namespace {

// For an error from a backup, getExtendedErrorCode() is negative and getErrorCode() already is the extended code.
int extended_code(const SQLite::Exception& problem) noexcept {
  return problem.getExtendedErrorCode() >= 0 ? problem.getExtendedErrorCode() : problem.getErrorCode();
}

}  // namespace

int primary_code(const SQLite::Exception& problem) noexcept {
  return problem.getErrorCode() & 0xff;
}

bool is_missing_parent(const SQLite::Exception& problem) noexcept {
  return extended_code(problem) == SQLITE_CONSTRAINT_FOREIGNKEY;
}

bool is_busy(const SQLite::Exception& problem) noexcept {
  return primary_code(problem) == SQLITE_BUSY || primary_code(problem) == SQLITE_LOCKED;
}

// True if the disk is full. SQLite reports SQLITE_FULL only for the database file: if the log's index cannot grow,
// SQLite reports a different code, and an exceeded quota shows only in errno.
bool is_full(const SQLite::Exception& problem, sqlite3* database) noexcept {
  if (primary_code(problem) == SQLITE_FULL || extended_code(problem) == SQLITE_IOERR_SHMSIZE) return true;
  if (primary_code(problem) != SQLITE_IOERR || database == nullptr) return false;
  const int reason = sqlite3_system_errno(database);
  return reason == ENOSPC || reason == EDQUOT;
}

std::string reason_of(const SQLite::Exception& problem, sqlite3* database) {
  if (is_missing_parent(problem)) return kDeleted;
  if (is_full(problem, database)) return "the disk is full";
  switch (primary_code(problem)) {
    case SQLITE_NOTADB:
      return "the file is not a gearshift history; nothing was changed";
    case SQLITE_CORRUPT:
      return "the file is damaged; nothing was changed";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "the file is read-only";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program has locked the file";
    case SQLITE_CANTOPEN:
      return "the file cannot be opened";
    case SQLITE_IOERR:
      return "the disk cannot be read or written";
    default:
      return problem.what();
  }
}

}  // namespace gearshift::lessons
