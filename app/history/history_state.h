// Inside this room: what the parts of History share. Nobody else sees SQLite.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "app/history/history.h"
#include "app/history/sqlite_words.h"

namespace gearshift {

struct History::State {
  State(const std::filesystem::path& path, Clock clock, std::chrono::milliseconds a_patience)
      : file(path), now(std::move(clock)), patience(a_patience) {}

  // history_open.cpp
  void open();       // to be written; made where there is none
  void open_copy();  // to be read: a copy in memory, of whatever may be read

  // history_write.cpp
  void insert_shift(std::int64_t run, const ShiftRecord& shift);
  void replace_faults(std::int64_t run, const LessonResult& result);

  // recording_place.cpp
  std::string recording_from_here(const std::string& recording) const;  // as a row has it

  std::string date() const { return date_text(now()); }
  SQLite::Statement query(const std::string& text) { return {*database, text}; }

  // One sentence whatever goes wrong; `work` is one transaction, seen whole or not at all, in a file that is still the
  // one that was opened.
  template <class Work>
  auto write(const Work& work) {
    return said([&] {
      SQLite::Transaction transaction(*database, SQLite::TransactionBehavior::IMMEDIATE);
      check_still_ours();
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
  auto said(const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const SQLite::Exception& problem) {
      fail(problem);
    }
  }
  std::string unusable(const std::string& why) const;
  [[noreturn]] void fail(const SQLite::Exception& problem) const;
  [[noreturn]] void refuse(const std::string& why) const;
  [[noreturn]] void fail_as_gone() const;  // what it belongs to was deleted

  std::filesystem::path file;
  Clock now;
  std::chrono::milliseconds patience;
  std::unique_ptr<SQLite::Database> database;

 private:
  std::string place() const;
  void check_still_ours();
  void check_may_be_written(const std::string& from) const;
  void name_recordings_from_here();
  int admitted_version();
  int version_in_file();
  void bring_up_to_date();
  void keep_log();
  void copy_what_may_be_locked(const std::string& from);
  void copy_what_nobody_writes(const std::string& from);
  void copy_from(SQLite::Database& source);
};

}  // namespace gearshift
