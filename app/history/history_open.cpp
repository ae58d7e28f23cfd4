#include <SQLiteCpp/Backup.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "app/history/history_state.h"
#include "app/history/schema.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr milliseconds kNap{10};

// What is refused is left to the byte: the log of a killed program is not worked in.
void leave_log_at_close(SQLite::Database& database, bool on) {
  sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, on ? 1 : 0, nullptr);
}

bool has_content(const fs::path& file) {
  std::error_code ignored;
  const std::uintmax_t size = fs::file_size(file, ignored);
  return !ignored && size > 0;
}

// Of the log: it may not be made, or there is no room for it. A disk that does not answer says so again.
bool lacks_index(const SQLite::Exception& problem) {
  const int code = short_code(problem);
  return code == SQLITE_CANTOPEN || code == SQLITE_READONLY || code == SQLITE_IOERR;
}

// By whoever runs this program; SQLite itself would open it to be read, and leave a log that nobody may write.
bool may_be_written(const fs::path& file) {
  return euidaccess(file.c_str(), W_OK) == 0;
}

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

using FileStamp = std::pair<fs::file_time_type, std::uintmax_t>;  // when it was written, how long it is

FileStamp stamp_of(const fs::path& file) {
  std::error_code ignored;
  return {fs::last_write_time(file, ignored), fs::file_size(file, ignored)};
}

// sqlite.org/uri.html, section 3.1
std::string immutable_uri(const std::string& absolute) {
  std::string uri = "file:";
  for (const char c : absolute) {
    const bool has_meaning = c == '?' || c == '#' || c == '%';
    uri += has_meaning ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return uri + "?immutable=1";
}

}  // namespace

void History::State::open() {
  std::error_code problem;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), problem);
  if (problem == std::errc::no_space_on_device) throw HistoryFull(problem.message());
  if (problem) refuse(fmt::format("its folder cannot be made: {}", problem.message()));
  const std::string from = place();
  check_may_be_written(from);
  const bool has_log = is_there(from + "-wal");
  said([&] {
    database = std::make_unique<SQLite::Database>(from, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                                                  static_cast<int>(patience.count()));
    if (has_log) leave_log_at_close(*database, true);
    const int version = admitted_version();
    if (version != kSchemaVersion) bring_up_to_date();
    keep_log();
    leave_log_at_close(*database, false);
    database->exec("PRAGMA foreign_keys = ON");
    database->exec("PRAGMA secure_delete = ON");
  });
}

// What a program without the right to write once left beside it keeps everybody from writing: named, to be removed.
void History::State::check_may_be_written(const std::string& from) const {
  if (is_there(from) && !may_be_written(from)) refuse("it may not be written");
  for (const char* beside : {"-wal", "-shm"}) {
    if (is_there(from + beside) && !may_be_written(from + beside))
      refuse(fmt::format("{}{} beside it may not be written", file.filename().string(), beside));
  }
}

// Nothing is written, nobody is kept waiting while it is read, and an older one is brought up to date in memory alone.
void History::State::open_copy() {
  const std::string from = place();
  said([&] {
    database = std::make_unique<SQLite::Database>(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    try {
      copy_what_may_be_locked(from);
    } catch (const SQLite::Exception& problem) {
      if (!lacks_index(problem)) throw;
      copy_what_nobody_writes(from);
    }
    if (admitted_version() != kSchemaVersion) bring_up_to_date();
    database->exec("PRAGMA query_only = ON");
  });
}

// With its log, where that stands beside it. A file that may not be written gets none made: what a reader without the
// right to write makes, nobody may write either.
void History::State::copy_what_may_be_locked(const std::string& from) {
  const bool has_log = is_there(from + "-wal");
  if (is_there(from) && !may_be_written(from) && !(has_log && is_there(from + "-shm")))
    return copy_what_nobody_writes(from);
  SQLite::Database source(from, SQLite::OPEN_READWRITE, static_cast<int>(patience.count()));
  if (has_log) leave_log_at_close(source, true);
  copy_from(source);
}

// Even who reads writes into the log's index; where none can be made, the file is taken to be as it is for good
// (sqlite.org/wal.html, "Read-Only Databases"). So it must be: without a log, and the same afterwards.
void History::State::copy_what_nobody_writes(const std::string& from) {
  if (has_content(from + "-wal"))
    refuse("it has a log beside it, which only a program that may write in that folder can read");
  const FileStamp before = stamp_of(from);
  SQLite::Database source(immutable_uri(from), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
  copy_from(source);
  if (stamp_of(from) != before || has_content(from + "-wal"))
    throw HistoryBusy(unusable("another program writes it just now"));
}

void History::State::copy_from(SQLite::Database& source) {
  SQLite::Backup backup(*database, source);
  const int result = backup.executeStep();
  if (result != SQLITE_DONE) throw SQLite::Exception("another program holds it", result);
}

// Absolute: "file:x" and ":memory:" are names of files, too.
std::string History::State::place() const {
  std::error_code problem;
  std::string absolute = fs::absolute(file, problem).string();
  if (problem) refuse(fmt::format("it cannot be found: {}", problem.message()));
  if (fs::is_directory(absolute, problem)) refuse("it cannot be read: it is a folder");
  if (is_there(absolute) && !fs::is_regular_file(absolute, problem)) refuse("it is no plain file");
  return absolute;
}

// One look at the file, whatever another program does to it meanwhile: that may be making it.
int History::State::admitted_version() {
  SQLite::Transaction look(*database);
  const int version = version_in_file();
  if (database->execAndGet("PRAGMA quick_check(1)").getString() != "ok") refuse("it is damaged; it is left as it is");
  return version;
}

// 0: nothing is in it yet, nobody's name either. Refuses what is another program's.
int History::State::version_in_file() {
  const int application = database->execAndGet("PRAGMA application_id").getInt();
  const int version = database->execAndGet("PRAGMA user_version").getInt();
  const bool is_empty = database->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
  const bool is_ours = application == kApplicationId;
  if (is_ours && version > kSchemaVersion) refuse("a newer program made it; it is left as it is");
  const bool is_new = is_empty && version == 0 && (is_ours || application == 0);
  if (!is_new && (is_empty || !is_ours || version < 1)) refuse("it is no history of this program; it is left as it is");
  return version;
}

void History::State::bring_up_to_date() {
  SQLite::Transaction transaction(*database, SQLite::TransactionBehavior::IMMEDIATE);
  // Another program may have been faster.
  for (int from = version_in_file(); from < kSchemaVersion; ++from) {
    database->exec(kMigrations[static_cast<std::size_t>(from)]);
    if (from + 1 == kRecordingsFromHere) name_recordings_from_here();
    database->exec(fmt::format("PRAGMA user_version = {}", from + 1));
  }
  database->exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  transaction.commit();
}

// One that was removed takes all that is written, and nobody ever reads it.
void History::State::check_still_ours() {
  int has_moved = 0;
  sqlite3_file_control(database->getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &has_moved);
  if (has_moved != 0) refuse("it was removed, or is another file now");
  const int version = database->execAndGet("PRAGMA user_version").getInt();
  if (version > kSchemaVersion) refuse("a newer program has taken it over; it is left as it is");
  if (version != kSchemaVersion) refuse("another program has changed its version; it is left as it is");
}

// Writing ahead needs the file alone for a moment, and SQLite does not wait for it by itself.
void History::State::keep_log() {
  for (milliseconds waited{0};; waited += kNap) {
    try {
      database->exec("PRAGMA journal_mode = WAL");
      break;
    } catch (const SQLite::Exception& problem) {
      if (!is_busy(problem) || waited >= patience) throw;
      sqlite3_sleep(static_cast<int>(kNap.count()));
    }
  }
  database->exec("PRAGMA synchronous = NORMAL");  // a killed process loses nothing; a dead machine the last seconds
}

}  // namespace gearshift
