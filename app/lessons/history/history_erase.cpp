#include <fmt/format.h>

#include "app/lessons/history/history_state.h"

namespace gearshift::lessons {
namespace {

// Recordings that only this learner's runs reference.
std::vector<std::string> recordings_of(SQLite::Database& database, std::int64_t learner) {
  SQLite::Statement rows(
      database,
      "SELECT DISTINCT recording FROM lesson_run WHERE recording != '' AND session IN (SELECT id FROM session WHERE "
      "learner = ?1) AND recording NOT IN (SELECT recording FROM lesson_run WHERE session NOT IN (SELECT id FROM "
      "session WHERE learner = ?1))");
  rows.bind(1, learner);
  std::vector<std::string> recordings;
  while (rows.executeStep()) recordings.push_back(rows.getColumn(0).getString());
  return recordings;
}

// Empties the write-ahead log. Returns an empty string, or the reason why the log could not be emptied. If another program is reading the file, SQLite
// does not throw but returns a nonzero result.
std::string empty_log(SQLite::Database& database) {
  const bool is_busy = database.execAndGet("PRAGMA wal_checkpoint(TRUNCATE)").getInt() != 0;
  return is_busy ? "another program is reading the file" : "";
}

// Returns the result of `work`, or the reason if `work` throws.
template <class Work>
std::string try_to(SQLite::Database& database, const Work& work) {
  try {
    return work();
  } catch (const SQLite::Exception& problem) {
    return reason_of(problem, database.getHandle());
  }
}

}  // namespace

std::vector<std::string> History::recordings(std::int64_t learner) {
  return state_->translating_errors([&] { return recordings_of(*state_->database, learner); });
}

std::string History::erase_learner(std::int64_t learner, const RecordingRemover& remove) {
  bool removed = false;
  try {
    state_->write([&] {
      const std::vector<std::string> recordings = recordings_of(*state_->database, learner);
      SQLite::Statement deletion = state_->query("DELETE FROM learner WHERE id = ?");
      deletion.bind(1, learner);
      deletion.exec();
      SQLite::Statement mark = state_->query("INSERT INTO pending_erasure VALUES (?)");
      mark.bind(1, state_->date());
      mark.exec();
      remove(recordings);
      removed = !recordings.empty();
    });
  } catch (const HistoryFull&) {
    throw HistoryFull(fmt::format("{}: the disk is full, so {}; delete again when there is space", file().string(),
                                  removed ? "only the recordings were deleted" : "nothing was deleted"));
  }
  return finish_erasure();
}

bool History::erasure_is_pending() {
  return state_->translating_errors(
      [&] { return state_->database->execAndGet("SELECT count(*) FROM pending_erasure").getInt64() > 0; });
}

// Completes an erasure. The deletion has overwritten the rows only in new pages of the log. VACUUM frees the space of
// these rows, and the checkpoint in empty_log() removes the old pages.
std::string History::finish_erasure() {
  SQLite::Database& database = *state_->database;
  const auto exec = [&](const char* text) {
    return try_to(database, [&] {
      database.exec(text);
      return std::string();
    });
  };
  std::string left = exec("VACUUM");
  const std::string log = try_to(database, [&] { return empty_log(database); });
  if (left.empty()) left = log;
  if (left.empty()) left = exec("DELETE FROM pending_erasure");
  if (left.empty()) return {};
  return fmt::format("{}: deleted data is not yet erased from the file because {}; delete again later", file().string(),
                     left);
}

}  // namespace gearshift::lessons
