// Writes pending data to the history in order. A write waits at most the lock timeout for a locked file.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/lessons/coach/learner_memory.h"

namespace gearshift::lessons {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kRetryInterval{500};  // shortest time between two write attempts
constexpr milliseconds kMaxWriteTime{50};    // limit per frame for all pending writes

// Returns text such as ", 2 runs"; empty if the count is 0.
std::string counted(std::ptrdiff_t count, const char* one, const char* many) {
  return count == 0 ? std::string() : fmt::format(", {} {}", count, count == 1 ? one : many);
}

}  // namespace

milliseconds LearnerMemory::current_lock_timeout() const {
  if (!flush_deadline_) return lock_timeout_;
  return std::max(kNoWait, std::chrono::duration_cast<milliseconds>(*flush_deadline_ - steady_clock::now()));
}

template <class Work>
LearnerMemory::WriteResult LearnerMemory::try_write(Person& owner, std::int64_t at, const Work& work) {
  write_time_ = at;
  history_->set_lock_timeout(std::exchange(is_locked_, false) ? kNoWait : current_lock_timeout());
  WriteResult result = WriteResult::retry;
  try {
    work();
    result = WriteResult::done;
    is_usable_ = true;
    is_disk_full_ = false;
    reported_.clear();
  } catch (const HistoryDeleted&) {
    result = WriteResult::dropped;
    owner.deleted = true;
  } catch (const HistoryBusy& problem) {
    is_locked_ = true;
    reason_ = problem.what();
    report(waiting_message_ = reason_ + "; new results are kept in memory until they can be saved");
  } catch (const HistoryFull& problem) {
    is_usable_ = false;
    is_disk_full_ = true;
    reason_ = problem.what();
    report(waiting_message_ = reason_ + kWaitsForRoom);
  } catch (const HistoryError& problem) {
    is_usable_ = false;
    reason_ = problem.what();
    report(reason_);
  }
  if (result == WriteResult::retry) next_try_ = steady_clock::now() + kRetryInterval;
  write_time_.reset();
  return result;
}

// True if the owner's data can still be saved: there is a learner, not deleted, and a history file.
bool LearnerMemory::waits_for_history(const Person& owner) const noexcept {
  return !owner.name.empty() && !owner.deleted && !file_.empty();
}

bool LearnerMemory::is_waiting(const PendingRun& run) const noexcept {
  return waits_for_history(*run.owner) && !run.written &&
         (run.over || run.row.id < 0 || run.shifts < run.row.result.shifts.size());
}

// A comment can be written only once its run has a number in the history.
bool LearnerMemory::is_waiting(const PendingComment& comment) const noexcept {
  return waits_for_history(*comment.owner) && !comment.written && comment.run > 0;
}

bool LearnerMemory::is_waiting(const PendingChoice& next) const noexcept {
  return waits_for_history(*next.owner) && !next.written;
}

bool LearnerMemory::is_waiting(const PendingRemoval& removal) const noexcept {
  return waits_for_history(*removal.owner) && !removal.written;
}

bool LearnerMemory::has_pending() const noexcept {
  const auto is_pending = [this](const auto& entry) { return is_waiting(entry); };
  return std::any_of(pending_runs_.begin(), pending_runs_.end(), is_pending) ||
         std::any_of(pending_comments_.begin(), pending_comments_.end(), is_pending) ||
         std::any_of(pending_choices_.begin(), pending_choices_.end(), is_pending) ||
         std::any_of(pending_removals_.begin(), pending_removals_.end(), is_pending);
}

// Returns text such as "2 runs, 1 comment".
std::string LearnerMemory::describe_pending() const {
  const auto is_pending = [this](const auto& entry) { return is_waiting(entry); };
  // Counts comments on unsaved runs as well.
  const auto is_unsaved = [this](const PendingComment& comment) {
    return waits_for_history(*comment.owner) && !comment.written;
  };
  const std::string text =
      counted(std::count_if(pending_runs_.begin(), pending_runs_.end(), is_pending), "run", "runs") +
      counted(std::count_if(pending_comments_.begin(), pending_comments_.end(), is_unsaved), "comment", "comments") +
      counted(std::count_if(pending_choices_.begin(), pending_choices_.end(), is_pending), "choice of the next lesson",
              "choices of the next lesson");
  return text.empty() ? text : text.substr(2);
}

bool LearnerMemory::retry_pending() {
  const Moment now = steady_clock::now();
  return now >= next_try_ && write_pending(now + kMaxWriteTime);
}

void LearnerMemory::write_now() {
  flush_failed_ = false;
  write_pending(steady_clock::now() + kMaxWriteTime);
}

void LearnerMemory::flush() {
  if (!has_pending()) return;
  is_locked_ = false;
  flush_deadline_ = steady_clock::now() + kHistoryLockTimeout;
  open(current_lock_timeout());
  write_pending(*flush_deadline_);
  flush_deadline_.reset();
  flush_failed_ = has_pending();
  const std::string unsaved = describe_pending();
  // If everything is saved now, drop the message about unsaved data.
  if (!flush_failed_ && (problem_ == loss_message_ || problem_ == waiting_message_)) problem_.reset();
  if (!unsaved.empty()) report(loss_message_ = fmt::format("{}; not saved: {}", reason_, unsaved));
}

// Writes in order, so an entry that cannot be written yet delays all later entries. Returns true if anything was
// written, or if data of a deleted learner was dropped.
bool LearnerMemory::write_pending(Moment until) {
  if (!history_ || !has_pending()) return false;
  bool any = false, keep_going = true;
  const auto write_one = [&](auto& entry) {
    if (!keep_going || !is_waiting(entry)) return;
    const WriteResult result = write(entry);
    any = any || result == WriteResult::done;
    keep_going = result != WriteResult::retry && steady_clock::now() < until;
  };
  for (PendingRun& run : pending_runs_) write_one(run);
  for (PendingComment& comment : pending_comments_) write_one(comment);
  for (PendingChoice& next : pending_choices_) write_one(next);
  for (PendingRemoval& removal : pending_removals_) write_one(removal);
  const auto is_written = [](const auto& entry) { return entry.written; };
  std::erase_if(pending_runs_, is_written);
  std::erase_if(pending_comments_, is_written);
  std::erase_if(pending_choices_, is_written);
  std::erase_if(pending_removals_, is_written);
  return drop_deleted() || any;
}

// Writes the start of the run. Then writes its new shifts or, once the run is over, its result.
LearnerMemory::WriteResult LearnerMemory::write(PendingRun& run) {
  const std::vector<ShiftRecord>& shifts = run.row.result.shifts;
  WriteResult result = WriteResult::done;
  if (run.row.id < 0) result = try_write(*run.owner, run.at, [&] { begin(run); });
  while (result == WriteResult::done && !run.over && run.shifts < shifts.size()) {
    result = try_write(*run.owner, run.at, [&] { history_->add_shift(run.row.id, shifts[run.shifts]); });
    if (result == WriteResult::done) ++run.shifts;
  }
  if (result != WriteResult::done || !run.over) return result;
  result = try_write(*run.owner, run.at, [&] { history_->end_run(run.row.id, run.row.result); });
  run.written = result == WriteResult::done;
  return result;
}

// Adds, edits or deletes a comment in the history. If another program has deleted the comment, it stays deleted.
LearnerMemory::WriteResult LearnerMemory::write(PendingComment& comment) {
  const WriteResult result = try_write(*comment.owner, comment.at, [&] {
    const CommentRow& row = comment.row;
    if (row.id < 0)
      history_->add_comment(comment.run, row.author, row.text);
    else if (comment.deleted)
      history_->delete_comment(row.id);
    else
      history_->edit_comment(row.id, row.text);
  });
  comment.written = result == WriteResult::done;
  return result;
}

LearnerMemory::WriteResult LearnerMemory::write(PendingChoice& next) {
  const WriteResult result =
      try_write(*next.owner, next.at, [&] { history_->set_next_lesson(id_for(*next.owner), next.lesson); });
  next.written = result == WriteResult::done;
  return result;
}

LearnerMemory::WriteResult LearnerMemory::write(PendingRemoval& removal) {
  const WriteResult result = try_write(*removal.owner, removal.at, [&] { history_->clear_recording(removal.run); });
  removal.written = result == WriteResult::done;
  return result;
}

void LearnerMemory::begin(PendingRun& run) {
  run.row.session = session_for(run);
  renumber(run, history_->begin_run(run.row.session, run.row.result, run.row.recording));
}

void LearnerMemory::renumber(PendingRun& run, std::int64_t number) {
  const std::int64_t before = std::exchange(run.row.id, number);
  for (RunRow& row : runs_) {
    if (row.id == before) row = run.row;
  }
  for (PendingComment& comment : pending_comments_) {
    if (comment.run == before) comment.run = number;
  }
  if (last_run_ == before) last_run_ = number;
}

std::int64_t LearnerMemory::session_for(const PendingRun& run) {
  if (!session_ || session_->owner != run.owner) {
    session_.reset();
    session_ = DrivingSession{run.owner, history_->begin_session(id_for(*run.owner), program_), std::nullopt};
  }
  if (session_->settings != run.settings) history_->add_settings(session_->id, run.settings);
  session_->settings = run.settings;
  return session_->id;
}

// Returns the learner's number in the history. Creates the learner if it has none yet. A deleted learner keeps the old
// number, so that writes for that learner fail.
std::int64_t LearnerMemory::id_for(Person& person) {
  if (person.id == 0) person.id = history_->find_or_add_learner(person.name);
  return person.id;
}

}  // namespace gearshift::lessons
