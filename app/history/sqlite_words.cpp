#include "app/history/sqlite_words.h"

#include <sqlite3.h>

#include <cerrno>

namespace gearshift {
namespace {

// A backup's problem has its code in the place of the short one.
int extended_code(const SQLite::Exception& problem) noexcept {
  return problem.getExtendedErrorCode() >= 0 ? problem.getExtendedErrorCode() : problem.getErrorCode();
}

}  // namespace

int short_code(const SQLite::Exception& problem) noexcept {
  return problem.getErrorCode() & 0xff;
}

bool is_gone(const SQLite::Exception& problem) noexcept {
  return extended_code(problem) == SQLITE_CONSTRAINT_FOREIGNKEY;
}

bool is_busy(const SQLite::Exception& problem) noexcept {
  return short_code(problem) == SQLITE_BUSY || short_code(problem) == SQLITE_LOCKED;
}

// SQLite says so of the file alone: its index of the log cannot grow there either, and a quota is another errno.
bool is_full(const SQLite::Exception& problem, sqlite3* database) noexcept {
  if (short_code(problem) == SQLITE_FULL || extended_code(problem) == SQLITE_IOERR_SHMSIZE) return true;
  if (short_code(problem) != SQLITE_IOERR || database == nullptr) return false;
  const int reason = sqlite3_system_errno(database);
  return reason == ENOSPC || reason == EDQUOT;
}

std::string reason_of(const SQLite::Exception& problem, sqlite3* database) {
  if (is_gone(problem)) return kDeleted;
  if (is_full(problem, database)) return "the disk is full";
  switch (short_code(problem)) {
    case SQLITE_NOTADB:
      return "it is no history of this program; it is left as it is";
    case SQLITE_CORRUPT:
      return "it is damaged; it is left as it is";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "it may not be written";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program holds it";
    case SQLITE_CANTOPEN:
      return "it cannot be opened";
    case SQLITE_IOERR:
      return "the disk does not answer";
    default:
      return problem.what();
  }
}

}  // namespace gearshift
