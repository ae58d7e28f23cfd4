#include <SQLiteCpp/Backup.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "app/lessons/history/history_state.h"
#include "app/lessons/history/schema.h"
#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr milliseconds kRetryInterval{10};

// Stops SQLite from merging a killed program's log into the file when it closes the file. A rejected file then stays
// unchanged to the byte.
void keep_log_at_close(SQLite::Database& database, bool on) {
  sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, on ? 1 : 0, nullptr);
}

bool has_content(const fs::path& file) {
  std::error_code ignored;
  const std::uintmax_t size = fs::file_size(file, ignored);
  return !ignored && size > 0;
}

// True if the error may mean that the log's index cannot be created: no permission or no space. If the cause is a
// failing disk, the next attempt fails with the same error.
bool cannot_create_index(const SQLite::Exception& problem) {
  const int code = primary_code(problem);
  return code == SQLITE_CANTOPEN || code == SQLITE_READONLY || code == SQLITE_IOERR;
}

// True if the current user may write to the file. Checked first, because SQLite would open a write-protected file
// read-only and leave a log that no one may write to.
bool is_writable(const fs::path& file) {
  return euidaccess(file.c_str(), W_OK) == 0;
}

bool file_exists(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

using FileStamp = std::pair<fs::file_time_type, std::uintmax_t>;  // modification time and size

FileStamp stamp_of(const fs::path& file) {
  std::error_code ignored;
  return {fs::last_write_time(file, ignored), fs::file_size(file, ignored)};
}

// Returns a URI that opens the file as immutable: sqlite.org/uri.html, section 3.1.
std::string immutable_uri(const std::string& absolute) {
  std::string uri = "file:";
  for (const char c : absolute) {
    const bool is_reserved = c == '?' || c == '#' || c == '%';
    uri += is_reserved ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return uri + "?immutable=1";
}

}  // namespace

void History::State::open() {
  std::error_code problem;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), problem);
  if (problem == std::errc::no_space_on_device) throw HistoryFull(problem.message());
  if (problem) refuse(fmt::format("the folder cannot be created ({})", problem.message()));
  const std::string from = absolute_path();
  check_writable(from);
  const bool has_log = file_exists(from + "-wal");
  translating_errors([&] {
    database = std::make_unique<SQLite::Database>(from, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                                                  static_cast<int>(lock_timeout.count()));
    if (has_log) keep_log_at_close(*database, true);
    const int version = checked_version();
    if (version != kSchemaVersion) upgrade();
    enable_write_ahead_log();
    keep_log_at_close(*database, false);
    database->exec("PRAGMA foreign_keys = ON");
    database->exec("PRAGMA secure_delete = ON");
  });
}

// Throws if the file or its log cannot be written. A log left by a program without write permission blocks all writers,
// so the error names this log and the user can remove it.
void History::State::check_writable(const std::string& from) const {
  if (file_exists(from) && !is_writable(from)) refuse("you have no permission to write to the file");
  for (const char* suffix : {"-wal", "-shm"}) {
    if (file_exists(from + suffix) && !is_writable(from + suffix))
      refuse(
          fmt::format("you have no permission to write to {}{} in the same folder", file.filename().string(), suffix));
  }
}

// Copies the file into memory. Writes nothing to disk and blocks no writer; an older version is upgraded only in
// memory.
void History::State::open_copy() {
  const std::string from = absolute_path();
  translating_errors([&] {
    database = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    try {
      copy_locked(from);
    } catch (const SQLite::Exception& problem) {
      if (!cannot_create_index(problem)) throw;
      copy_immutable(from);
    }
    if (checked_version() != kSchemaVersion) upgrade();
    upgrade_note.clear();  // the file itself is unchanged
    database->exec("PRAGMA query_only = ON");
  });
}

void History::State::open_memory() {
  translating_errors([&] {
    database = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    upgrade();
    database->exec("PRAGMA foreign_keys = ON");
  });
}

// Copies the file with its log, if there is one. If the file is not writable, creates no log, because no other program
// could write to that log either.
void History::State::copy_locked(const std::string& from) {
  const bool has_log = file_exists(from + "-wal");
  if (file_exists(from) && !is_writable(from) && !(has_log && file_exists(from + "-shm"))) return copy_immutable(from);
  SQLite::Database source(from, SQLite::OPEN_READWRITE, static_cast<int>(lock_timeout.count()));
  if (has_log) keep_log_at_close(source, true);
  copy_from(source);
}

// Copies a file for which no log index can be created. SQLite needs the index even for reading, unless the file is
// opened as immutable (sqlite.org/wal.html, "Read-Only Databases"). The copy is correct only if there is no log and if
// the file is unchanged afterwards.
void History::State::copy_immutable(const std::string& from) {
  if (has_content(from + "-wal"))
    refuse("the file has a write-ahead log, which can only be read with write permission in the file's folder");
  const FileStamp before = stamp_of(from);
  SQLite::Database source(immutable_uri(from), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
  copy_from(source);
  if (stamp_of(from) != before || has_content(from + "-wal"))
    throw HistoryBusy(unusable_message("another program is writing to the file"));
}

void History::State::copy_from(SQLite::Database& source) {
  SQLite::Backup backup(*database, source);
  const int result = backup.executeStep();
  if (result != SQLITE_DONE) throw SQLite::Exception("another program has locked the file", result);
}

// Returns an absolute path, because SQLite would treat the valid file names "file:x" and ":memory:" specially.
std::string History::State::absolute_path() const {
  std::error_code problem;
  std::string absolute = fs::absolute(file, problem).string();
  if (problem) refuse(fmt::format("the file cannot be found ({})", problem.message()));
  if (fs::is_directory(absolute, problem)) refuse("this is a folder, not a file");
  if (file_exists(absolute) && !fs::is_regular_file(absolute, problem)) refuse("this is not a regular file");
  return absolute;
}

// Checks the file and returns the version of its schema, in one transaction, because another program may be creating
// the file at this moment.
int History::State::checked_version() {
  SQLite::Transaction snapshot(*database);
  const int version = version_in_file();
  if (database->execAndGet("PRAGMA quick_check(1)").getString() != "ok")
    refuse("the file is damaged; nothing was changed");
  return version;
}

// Returns the version of the schema, 0 for an empty file. Rejects files of other programs.
int History::State::version_in_file() {
  const int application = database->execAndGet("PRAGMA application_id").getInt();
  const int version = database->execAndGet("PRAGMA user_version").getInt();
  const bool is_empty = database->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
  const bool is_history = application == kApplicationId;
  if (application == kOldApplicationId)
    refuse(
        "the file was written by an old version of gearshift and can no longer be read; nothing was changed; rename or "
        "delete the file to start a new history");
  if (is_history && version > kSchemaVersion)
    refuse("the file was written by a newer version of gearshift; nothing was changed");
  const bool is_new = is_empty && version == 0 && (is_history || application == 0);
  if (!is_new && (is_empty || !is_history || version < 1))
    refuse("the file is not a gearshift history; nothing was changed");
  return version;
}

// Creates the tables of an empty file, or upgrades an older file.
void History::State::upgrade() {
  SQLite::Transaction transaction(*database, SQLite::TransactionBehavior::IMMEDIATE);
  // Read the version again, because another program may have done this in the meantime.
  const int version = version_in_file();
  if (version == 0)
    database->exec(schema());
  else
    run_scripts(version);
  database->exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
  database->exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  transaction.commit();
}

void History::State::run_scripts(int version) {
  const auto scripts = upgrades();
  for (std::size_t i = static_cast<std::size_t>(version - 1); i < scripts.size(); ++i) {
    database->exec(scripts[i]);
    if (i == 0) join_equal_learners();
  }
}

// Version 1 compared names byte by byte, so one name in two forms was two learners. Gives their sessions to the older
// one, and stores every name in its stored form.
void History::State::join_equal_learners() {
  std::vector<LearnerRow> rows = learners(), kept;
  std::sort(rows.begin(), rows.end(), [](const LearnerRow& a, const LearnerRow& b) { return a.id < b.id; });
  std::string joined;
  for (LearnerRow& row : rows) {
    row.name = stored_name(row.name);
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const LearnerRow& k) { return k.name == row.name; });
    if (same == kept.end()) {
      kept.push_back(row);
      continue;
    }
    join_learners(same->id, row.id);
    joined += (joined.empty() ? "" : ", ") + haptics::printable(row.name);
  }
  for (const LearnerRow& row : kept) {
    SQLite::Statement update = query("UPDATE learner SET name = ? WHERE id = ?");
    update.bind(1, row.name);
    update.bind(2, row.id);
    update.exec();
  }
  if (!joined.empty())
    upgrade_note = fmt::format("{}: learners whose names look the same were joined, with all their runs: {}",
                               file.string(), joined);
}

// Gives the sessions and the next lesson of the learner `other` to the learner `kept`, and deletes `other`.
void History::State::join_learners(std::int64_t kept, std::int64_t other) {
  for (const char* text : {"UPDATE session SET learner = ?1 WHERE learner = ?2",
                           "UPDATE learner SET next_lesson = (SELECT next_lesson FROM learner WHERE id = ?2) "
                           "WHERE id = ?1 AND next_lesson = ''",
                           "DELETE FROM learner WHERE id = ?2 AND ?1 > 0"}) {
    SQLite::Statement statement = query(text);
    statement.bind(1, kept);
    statement.bind(2, other);
    statement.exec();
  }
}

// Throws if the file was removed, replaced or upgraded. Writes to a removed file would succeed, but no one could read
// them.
void History::State::check_still_current() {
  int has_moved = 0;
  sqlite3_file_control(database->getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &has_moved);
  if (has_moved != 0) refuse("the file was removed or replaced");
  const int version = database->execAndGet("PRAGMA user_version").getInt();
  if (version > kSchemaVersion) refuse("a newer version of gearshift has upgraded the file; nothing was written");
  if (version != kSchemaVersion) refuse("another program has changed the version of the file; nothing was written");
}

// Switching to a write-ahead log needs exclusive access for a moment. SQLite does not wait for this access, so this
// function tries again.
void History::State::enable_write_ahead_log() {
  for (milliseconds waited{0};; waited += kRetryInterval) {
    try {
      database->exec("PRAGMA journal_mode = WAL");
      break;
    } catch (const SQLite::Exception& problem) {
      if (!is_busy(problem) || waited >= lock_timeout) throw;
      sqlite3_sleep(static_cast<int>(kRetryInterval.count()));
    }
  }
  // With this setting, a killed process loses nothing; a power failure may lose the last seconds.
  database->exec("PRAGMA synchronous = NORMAL");
}

}  // namespace gearshift::lessons
