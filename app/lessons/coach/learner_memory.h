// Saves a learner's runs, comments and choices in the history, and keeps them in memory until they are saved.
//
// This class runs in the frame loop, which also polls the STOP button and must not block. If another program locks the
// file, only the first write waits, at most for the lock timeout. Later attempts do not wait while the file stays
// locked.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "app/lessons/history/history.h"

namespace gearshift::lessons {

// Problems with the history do not throw; take_problem() returns each of them once, as one sentence. Data that could
// not be saved is kept in order; each later write and retry_pending() try again to save it. An entry that keeps failing
// while others are saved is given up and reported. Learners are identified by their number in the history, not by name.
// If another program deletes a learner, this class reports it, drops the learner's pending data and does not create the
// learner again.
class LearnerMemory {
 public:
  LearnerMemory(const std::filesystem::path& history, std::string program, Clock now,
                std::chrono::milliseconds lock_timeout);
  ~LearnerMemory();  // flushes, unless a flush has failed already
  LearnerMemory(const LearnerMemory&) = delete;
  LearnerMemory& operator=(const LearnerMemory&) = delete;

  // True if results can be saved. Stays true while another program locks the history for a moment.
  bool is_usable() const noexcept { return history_ && is_usable_ && !is_learner_deleted(); }
  std::optional<std::string> take_problem();
  std::string problem() const { return problem_.value_or(""); }     // problem not yet returned, or empty
  std::vector<std::string> learners();                              // sorted by name
  std::optional<std::string> known_name(const std::string& typed);  // the learner whom the name means (find_name())

  // Selects the learner with exactly this name. If there is none, selects a new learner. An empty name selects no
  // learner. Writes nothing to the history.
  void set_learner(const std::string& name);
  // Renames the learner. `name`: checked, and of no other learner. If another program gives the name to another learner
  // before it is saved, the old name returns, and the problem is reported.
  void rename_learner(const std::string& name);
  const std::string& learner() const noexcept { return person_->name; }
  // True if another program deleted the learner: nothing is written until the next set_learner(), even with the same
  // name.
  bool is_learner_deleted() const noexcept { return person_->deleted; }
  // Reads the history again if another program has changed it, and opens a history that could not be opened before.
  void reload();

  // Runs of the current learner, oldest first. Unsaved runs are included and have negative numbers.
  const std::vector<RunRow>& runs() const noexcept { return runs_; }
  std::vector<CommentRow> comments(std::int64_t run) const;  // unsaved comments have negative numbers
  void add_comment(std::int64_t run, const std::string& author, const std::string& text);
  void edit_comment(std::int64_t run, std::int64_t comment, const std::string& text);
  void delete_comment(std::int64_t run, std::int64_t comment);
  const std::string& next_lesson() const noexcept { return next_; }  // key, or empty
  void set_next_lesson(const std::string& lesson);

  // Call begin_run() at the first sample of a run and end_run() at its end.
  void begin_run(const LessonResult& result, const std::string& recording);
  bool in_run() const noexcept { return in_run_; }
  void add_shift(const ShiftRecord& shift);
  void end_run(const LessonResult& result);
  void clear_recording();  // removes the recording from the current or last run
  // Number of the current or last run in the history; 0 while part of the run is not saved.
  std::int64_t run_number() const noexcept;

  // Retries pending writes, at most twice per second however often it is called. Returns true if something was written,
  // or if data of a deleted learner was dropped.
  bool retry_pending();
  // Writes all pending data before the program ends, waiting for the history for at most 3 s. Reports data that is
  // still pending as a problem.
  void flush();
  // True if writes are pending because the disk is full.
  bool needs_room() const noexcept { return is_disk_full_; }
  // Returns recordings that the history will never reference, each at most once.
  std::vector<std::string> take_unreferenced_recordings();

 private:
  using Moment = std::chrono::steady_clock::time_point;

  // retry: nothing can be saved now; failed: this entry failed several times; dropped: the learner was deleted
  enum class WriteResult { done, retry, failed, dropped };

  struct Person {
    std::string name;     // empty: no learner
    std::int64_t id = 0;  // number in the history; 0: not there yet
    bool deleted = false;
  };
  using PersonPtr = std::shared_ptr<Person>;  // shared by all pending writes of one learner

  // Data that waits to be written.
  struct PendingRun {
    RunRow row;
    std::size_t shifts = 0;  // number of shifts already written
    bool over = false;
  };
  struct PendingComment {
    std::int64_t run = 0;
    CommentRow row;  // id < 0: a new comment; else new content of an existing comment
    bool deleted = false;
  };
  struct PendingChoice {
    std::string lesson;
  };
  struct PendingName {
    std::string before, name;
  };
  struct PendingRemoval {  // removes the recording from a saved run
    std::int64_t run = 0;
  };
  struct PendingWrite {
    PersonPtr owner;
    std::int64_t at = 0;  // [s] since 1970
    std::variant<PendingRun, PendingComment, PendingChoice, PendingName, PendingRemoval> what;
    bool written = false;
    int failures = 0;   // failed attempts since the last success, without those on a locked file or a full disk
    bool lost = false;  // given up, but still shown
  };
  struct DrivingSession {
    PersonPtr owner;
    std::int64_t id = 0;
  };

  static constexpr const char* kWaitsForRoom = "; new results are kept in memory until there is space";

  void open(std::chrono::milliseconds lock_timeout);
  void report(const std::string& problem);
  std::chrono::milliseconds current_lock_timeout() const;
  template <class Work>
  bool read(const Work& work);  // returns false if reading fails or there is no history
  PersonPtr find_or_add_person(const std::string& name);
  bool has_pending_name(const PersonPtr& person) const noexcept;
  void load();
  bool drop_deleted();
  bool drop_pending_of(const PersonPtr& person);
  template <class What>
  static void each_pending(auto& queue, const auto& visit);  // visit(entry, what) for the entries of this type
  bool waits_for_history(const Person& owner) const noexcept;
  static bool is_written(const PendingWrite& entry) noexcept { return entry.written; }
  bool is_waiting(const PendingWrite& entry) const noexcept;
  bool has_pending() const noexcept;
  std::string describe_pending() const;
  void write_now();
  bool write_pending(Moment until);
  WriteResult try_write(PendingWrite& entry);
  void give_up(std::span<PendingWrite* const> failed);
  void write(PendingWrite& entry, PendingRun& run);
  void write(PendingWrite& entry, PendingComment& comment);
  static void apply(const PendingComment& change, std::vector<CommentRow>& comments);
  void write(PendingWrite& entry, const PendingChoice& choice);
  void write(PendingWrite& entry, const PendingName& name);
  void write(PendingWrite& entry, const PendingRemoval& removal);
  PendingWrite& current_run() noexcept;
  PendingWrite& find_or_add_comment(std::int64_t run, std::int64_t comment);
  void renumber(PendingRun& run, std::int64_t number);
  std::int64_t session_for(const PersonPtr& owner);
  std::int64_t id_for(Person& person);

  static constexpr std::chrono::milliseconds kNoWait{0};  // lock timeout for a file that is known to be locked

  std::filesystem::path file_;
  std::string program_;
  Clock now_;
  std::chrono::milliseconds lock_timeout_;
  std::optional<Moment> flush_deadline_;
  std::optional<std::int64_t> write_time_;  // [s] since 1970: date of the current write; empty: now
  std::unique_ptr<History> history_;
  bool is_usable_ = true;  // false after a failed read or write; a locked file does not count
  // True if another program had locked the file at the last write (is_locked_) or read (is_read_blocked_).
  bool is_locked_ = false, is_read_blocked_ = false;
  bool is_disk_full_ = false;      // the disk was full at the last attempt
  bool flush_failed_ = false;      // the last flush failed and nothing was added since
  std::string reported_, reason_;  // last reported problem; last reason why a write is pending
  std::string loss_message_;       // last message about unsaved data
  std::string waiting_message_;    // last message about pending writes
  std::optional<std::string> problem_;

  PersonPtr person_ = std::make_shared<Person>();  // the current learner
  std::vector<PersonPtr> people_;                  // all learners selected so far, without deleted ones
  std::string next_;
  std::vector<RunRow> runs_;
  std::optional<std::int64_t> changes_;  // History::changes() at the last read; empty: not read yet
  std::optional<DrivingSession> session_;

  // Data that is not saved in the history yet.
  // Oldest first; includes the run in progress; at most one choice and one name per learner.
  std::vector<PendingWrite> pending_;
  std::vector<std::string> unreferenced_recordings_;
  bool in_run_ = false;
  std::int64_t last_run_ = 0;       // number of the last run
  std::int64_t last_local_id_ = 0;  // last temporary (negative) number
  Moment next_try_{};
};

template <class What>
void LearnerMemory::each_pending(auto& queue, const auto& visit) {
  for (auto& entry : queue) {
    if (auto* what = std::get_if<What>(&entry.what)) visit(entry, *what);
  }
}

}  // namespace gearshift::lessons
