// Private to this folder: the state that the parts of History share. SQLite is not visible outside this folder.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "app/lessons/history/history.h"
#include "app/lessons/history/sqlite_errors.h"

namespace gearshift::lessons {

std::filesystem::path history_folder(const std::filesystem::path& history);  // absolute (recording_path.cpp)

struct History::State {
  State(const std::filesystem::path& path, Clock clock, std::chrono::milliseconds timeout)
      : file(path), now(std::move(clock)), lock_timeout(timeout) {}

  // history_open.cpp
  void open();       // opens the file for writing; creates it if it is missing
  void open_copy();  // copies the file into memory, for reading
  void open_memory();

  // history_write.cpp
  std::int64_t insert_numbered(SQLite::Statement& insert, int index, const char* kind);
  void insert_shift(std::int64_t run, const ShiftRecord& shift);
  void replace_errors(std::int64_t run, const LessonResult& result);

  // history_read.cpp
  std::vector<LearnerRow> learners();
  std::optional<LearnerRow> find_learner(std::string_view name);

  // history_open.cpp
  void join_learners(std::int64_t kept, std::int64_t other);

  // recording_path.cpp
  std::string relative_recording(const std::string& recording) const;  // path as stored in the history

  std::string date() const { return format_utc(now()); }
  SQLite::Statement query(const std::string& text) { return {*database, text}; }

  // Runs `work` in one transaction and turns SQLite's exceptions into HistoryError. Fails if the file is no longer the
  // one that was opened.
  template <class Work>
  auto write(const Work& work) {
    return translating_errors([&] {
      SQLite::Transaction transaction(*database, SQLite::TransactionBehavior::IMMEDIATE);
      check_still_current();
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        transaction.commit();
      } else {
        auto result = work();
        transaction.commit();
        return result;
      }
    });
  }
  template <class Work>
  auto translating_errors(const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const SQLite::Exception& problem) {
      fail(problem);
    }
  }
  std::string unusable_message(const std::string& why) const;
  [[noreturn]] void fail(const SQLite::Exception& problem) const;
  [[noreturn]] void refuse(const std::string& why) const;
  [[noreturn]] void fail_as_deleted() const;  // throws HistoryDeleted, because the learner, run or comment was deleted

  std::filesystem::path file;
  Clock now;
  std::chrono::milliseconds lock_timeout;
  std::unique_ptr<SQLite::Database> database;
  std::string upgrade_note;

 private:
  std::string absolute_path() const;
  void check_still_current();
  void check_writable(const std::string& from) const;
  int checked_version();
  int version_in_file();
  void upgrade();
  void run_scripts(int version);
  void join_equal_learners();
  void enable_write_ahead_log();
  void copy_locked(const std::string& from);
  void copy_immutable(const std::string& from);
  void copy_from(SQLite::Database& source);
};

}  // namespace gearshift::lessons
