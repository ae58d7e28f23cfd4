// What is remembered of learners: one SQLite file, by default history.db in the user's data folder.
//
// Every call that writes is one transaction: a process that is killed loses the shift in progress and nothing else. Two
// programs may use one file at once. A file that cannot be used is left as it is: the caller goes on without a history.
// One thread.
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

#include "app/history/date_text.h"
#include "app/history/typed_text.h"
#include "app/training/lesson_result.h"

namespace gearshift {

// One sentence that names the file: damaged, of a newer program, read-only, the disk is full, ...
struct HistoryError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct HistoryBusy : HistoryError {  // another program holds it: it may be free in a moment
  using HistoryError::HistoryError;
};
struct HistoryGone : HistoryError {  // its learner was erased: it is never taken
  using HistoryError::HistoryError;
};
struct HistoryFull : HistoryError {  // the disk: nothing of this call was written, all before it stays
  using HistoryError::HistoryError;
};

struct LearnerRow {
  std::int64_t id = 0;
  std::string name;
  std::string made_at;      // ISO 8601, UTC
  std::string next_lesson;  // as the instructor wants it; empty: as suggested
};

struct RunRow {
  std::int64_t id = 0;
  std::int64_t session = 0;
  std::string begun_at;   // ISO 8601, UTC
  std::string recording;  // trace file, from the history's folder where it lies below that, else absolute; or empty
  LessonResult result;    // with faults, deductions and shifts; figures are finite, whoever wrote them
};

// To its end, whatever that was: a run that was left, or never ended, is no practice and no test.
inline bool was_driven(const RunRow& run) noexcept {
  return run.result.end != LessonEnd::running && run.result.end != LessonEnd::left;
}

struct CommentRow {
  std::string at;  // ISO 8601, UTC
  std::string author, text;
  std::int64_t id = 0;
  std::string edited_at{};  // ISO 8601, UTC; empty: it is as it was first said
};

using RecordingRemover = std::function<void(const std::vector<std::string>&)>;  // must not throw

inline constexpr std::chrono::milliseconds kHistoryPatience{3000};  // for another program that writes

enum class HistoryUse {
  write,  // made where there is none, brought up to date where it is older
  read    // a copy in memory, as it is now: neither file nor folder need be writable; what writes throws HistoryError
};

class History {
 public:
  // Opens or makes it, with its folder; the clock dates what is written. Throws HistoryError, as every other call does;
  // HistoryBusy where it was held for longer than the patience.
  explicit History(const std::filesystem::path& file, Clock now = system_seconds,
                   std::chrono::milliseconds patience = kHistoryPatience, HistoryUse use = HistoryUse::write);
  ~History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  void set_patience(std::chrono::milliseconds patience);  // of each call; 0: none

  // Known or made. Throws std::invalid_argument for what is no name.
  std::int64_t learner(std::string_view name);
  std::optional<LearnerRow> find_learner(std::string_view name);
  std::vector<LearnerRow> learners();
  void set_next_lesson(std::int64_t learner, std::string_view lesson);  // empty: as suggested

  std::int64_t begin_session(std::int64_t learner, std::string_view program);
  // What was set from then on: gate, car, preset, as text.
  void add_settings(std::int64_t session, std::string_view text);

  // The result as far as it is known: lesson, task, mode, guided. A recording below the history's folder is kept by its
  // way from there: folder and history can be moved, or copied, together.
  std::int64_t begin_run(std::int64_t session, const LessonResult& result, std::string_view recording);
  void add_shift(std::int64_t run, const ShiftRecord& shift);
  // The end of it; shifts that add_shift() has not seen are added.
  void end_run(std::int64_t run, const LessonResult& result);
  void forget_recording(std::int64_t run);  // there is none (any more)

  // The instructor's. Throw std::invalid_argument for what is no name, no comment (typed_text.h). False: there is no
  // such comment (any more).
  std::int64_t add_comment(std::int64_t run, std::string_view author, std::string_view text);  // its number
  bool edit_comment(std::int64_t comment, std::string_view text);  // the last text is the one that counts
  bool delete_comment(std::int64_t comment);

  std::vector<RunRow> runs(std::int64_t learner);  // oldest first
  std::vector<CommentRow> comments(std::int64_t run);
  std::vector<std::string> settings(std::int64_t session);

  // Where RunRow::recording is: absolute; empty stays empty.
  std::filesystem::path recording_file(std::string_view recording) const;
  // Of this learner's runs, as their rows have them: those that nobody else names.
  std::vector<std::string> recordings(std::int64_t learner);

  // Another number than before: another program, or another History, has written since.
  std::int64_t changes();

  // Rows, and by `remove` the recordings that nobody else names, in one transaction: killed within it, the learner is
  // still there to be erased. Returns empty when all of it is out of the file and its log for good; else, in one
  // sentence, what keeps it there: that is pending until finish_erasure(), which returns the same.
  [[nodiscard]] std::string erase_learner(std::int64_t learner, const RecordingRemover& remove);
  bool erasure_is_pending();
  [[nodiscard]] std::string finish_erasure();

  const std::filesystem::path& file() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
