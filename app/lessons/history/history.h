// The history of learners in one SQLite file, by default history.db in the user's data folder.
//
// Every call that writes is one transaction, so a killed process loses only the shift in progress. Two programs may use
// one file at once. A file that cannot be used is left unchanged, and the caller continues without a history. Use from
// one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/history/user_text.h"
#include "app/lessons/history/utc_time.h"

namespace gearshift::lessons {

// what() is one sentence that names the file and the reason: damaged, from a newer program, read-only, disk full, ...
struct HistoryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct HistoryBusy : HistoryError {  // another program has locked the file, perhaps only for a moment
  using HistoryError::HistoryError;
};
struct HistoryDeleted : HistoryError {  // the learner was erased, so the call can never succeed
  using HistoryError::HistoryError;
};
struct HistoryFull : HistoryError {  // disk full: the call has written nothing; earlier data is kept
  using HistoryError::HistoryError;
};

struct LearnerRow {
  std::int64_t id = 0;
  std::string name;
  std::string made_at;      // ISO 8601, UTC
  std::string next_lesson;  // lesson chosen by the instructor; empty: the suggested lesson
};

struct CommentRow {
  std::string at;  // ISO 8601, UTC
  std::string author, text;
  std::int64_t id = 0;
  std::string edited_at{};  // ISO 8601, UTC; empty: never edited
};

struct RunRow {
  std::int64_t id = 0;
  std::int64_t session = 0;
  std::string begun_at;                // ISO 8601, UTC
  std::string recording;               // trace file, relative to the history's folder if inside it; may be empty
  LessonResult result;                 // with driving errors and shifts; all numbers are finite even in a damaged file
  std::vector<CommentRow> comments{};  // by the instructor, oldest first
  std::string kept_at{};  // where the recording is if another seat has it: "HOST:/folder/file"; may be empty
};

// True if the run was driven to its end, whatever the result. Runs that the learner left or that never ended count
// neither as practice nor as a retention test.
inline bool was_completed(const RunRow& run) noexcept {
  return run.result.end != LessonEnd::running && run.result.end != LessonEnd::left;
}

using RecordingRemover = std::function<void(const std::vector<std::string>&)>;  // must not throw

// Default time that a call waits for another program that is writing.
inline constexpr std::chrono::milliseconds kHistoryLockTimeout{3000};

enum class HistoryUse {
  write,  // creates a missing file
  // Works on a copy of the current state in memory: neither file nor folder needs write permission, and calls that
  // write throw HistoryError.
  read,
  memory  // a new history in memory; the file's name is used only in messages
};

class History {
 public:
  // Opens the file, or creates the file and its folder. `now` provides the dates that are written. This constructor and
  // all other functions throw HistoryError, or HistoryBusy if the file stays locked for longer than `lock_timeout`.
  explicit History(const std::filesystem::path& file, Clock now = system_seconds,
                   std::chrono::milliseconds lock_timeout = kHistoryLockTimeout, HistoryUse use = HistoryUse::write);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  void set_lock_timeout(std::chrono::milliseconds lock_timeout);  // applies to each call; 0: do not wait

  // A sentence on learners that were joined when the file was upgraded, because their names look equal; else empty.
  const std::string& upgrade_note() const noexcept;

  // Returns the number of the learner whom the name means (find_name() in user_text.h); adds the learner if there is
  // none. Throws std::invalid_argument for an invalid new name.
  std::int64_t find_or_add_learner(std::string_view name);
  std::optional<LearnerRow> find_learner(std::string_view name);
  std::vector<LearnerRow> learners();
  // Returns false, and changes nothing, if the name means another learner. Throws std::invalid_argument.
  bool rename_learner(std::int64_t learner, std::string_view name);
  void set_next_lesson(std::int64_t learner, std::string_view lesson);  // empty: as suggested

  std::int64_t begin_session(std::int64_t learner, std::string_view program);

  // Stores what is known at the start of a run: lesson, task, mode, guided. A recording below the history's folder is
  // stored with its relative path, so that the folder can be moved or copied with its recordings.
  std::int64_t begin_run(std::int64_t session, const LessonResult& result, std::string_view recording);
  void add_shift(std::int64_t run, const ShiftRecord& shift);
  // Stores the final result; adds shifts that were not added by add_shift().
  void end_run(std::int64_t run, const LessonResult& result);
  void clear_recording(std::int64_t run);  // removes the path of the run's recording

  // Comments by the instructor. The functions throw std::invalid_argument for an invalid name or comment (user_text.h).
  // edit_comment() and delete_comment() return false if the comment does not exist (any more).
  std::int64_t add_comment(std::int64_t run, std::string_view author, std::string_view text);  // returns its number
  bool edit_comment(std::int64_t comment, std::string_view text);  // only the newest text is kept
  bool delete_comment(std::int64_t comment);

  std::vector<RunRow> runs(std::int64_t learner);  // oldest first

  // Returns the absolute path of a RunRow::recording; empty for an empty path.
  std::filesystem::path recording_file(std::string_view recording) const;
  // Returns the recordings that only this learner's runs reference, with their paths as stored.
  std::vector<std::string> recordings(std::int64_t learner);

  // Returns a number that changes whenever another program, or another History, writes to the file.
  std::int64_t changes();

  // Deletes the learner's rows in one transaction, and calls `remove` with the recordings that no other learner
  // references. If the process is killed meanwhile, the learner can be erased again. Returns an empty string once the
  // data is erased from the file and its log. Otherwise returns one sentence on the obstacle, and the erasure stays
  // pending until finish_erasure() succeeds. The result of finish_erasure() has the same meaning.
  [[nodiscard]] std::string erase_learner(std::int64_t learner, const RecordingRemover& remove);
  bool erasure_is_pending();
  [[nodiscard]] std::string finish_erasure();

  const std::filesystem::path& file() const noexcept;

 private:
  friend class Exchange;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::lessons
