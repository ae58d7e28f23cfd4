#include "app/lessons/history/history.h"

#include <sqlite3.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/lessons/history/history_state.h"

namespace gearshift::lessons {

History::History(const std::filesystem::path& file, Clock now, std::chrono::milliseconds lock_timeout, HistoryUse use)
    : state_(std::make_unique<State>(file, std::move(now), lock_timeout)) {
  try {
    switch (use) {
      case HistoryUse::write:
        state_->open();
        break;
      case HistoryUse::read:
        state_->open_copy();
        break;
      case HistoryUse::memory:
        state_->open_memory();
        break;
    }
  } catch (const HistoryFull&) {
    std::error_code none;
    const bool is_new = std::filesystem::file_size(file, none) == 0 || none;
    throw HistoryFull(file.string() +
                      (is_new ? ": the history cannot be created because the disk is full"
                              : ": the history cannot be opened because the disk is full; the file is unchanged"));
  }
}

History::~History() = default;

void History::set_lock_timeout(std::chrono::milliseconds lock_timeout) {
  sqlite3_busy_timeout(state_->database->getHandle(), static_cast<int>(lock_timeout.count()));
}

const std::filesystem::path& History::file() const noexcept {
  return state_->file;
}

const std::string& History::upgrade_note() const noexcept {
  return state_->upgrade_note;
}

std::int64_t History::changes() {
  return state_->translating_errors([&] { return state_->database->execAndGet("PRAGMA data_version").getInt64(); });
}

void History::State::fail(const SQLite::Exception& problem) const {
  sqlite3* const handle = database ? database->getHandle() : nullptr;
  if (is_missing_parent(problem)) fail_as_deleted();
  if (is_full(problem, handle))
    throw HistoryFull(
        fmt::format("{}: the disk is full, so nothing more can be saved; earlier results are kept", file.string()));
  const std::string sentence = unusable_message(reason_of(problem, handle));
  if (is_busy(problem)) throw HistoryBusy(sentence);
  throw HistoryError(sentence);
}

void History::State::refuse(const std::string& why) const {
  throw HistoryError(unusable_message(why));
}

void History::State::fail_as_deleted() const {
  throw HistoryDeleted(unusable_message(kDeleted));
}

std::string History::State::unusable_message(const std::string& why) const {
  return fmt::format("{}: the history cannot be used because {}", file.string(), why);
}

}  // namespace gearshift::lessons
