// Writes pending data to the history in order. A write waits at most the lock timeout for a locked file.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "app/lessons/coach/learner_memory.h"
#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kRetryInterval{500};  // shortest time between two write attempts
constexpr milliseconds kMaxWriteTime{50};    // limit per frame for all pending writes
constexpr int kMaxFailures = 3;              // attempts after which an entry no longer delays the entries after it

// Returns text such as ", 2 runs"; empty if the count is 0.
std::string counted(std::ptrdiff_t count, const char* one, const char* many) {
  return count == 0 ? std::string() : fmt::format(", {} {}", count, count == 1 ? one : many);
}

}  // namespace

milliseconds LearnerMemory::current_lock_timeout() const {
  if (!flush_deadline_) return lock_timeout_;
  return std::max(kNoWait, std::chrono::duration_cast<milliseconds>(*flush_deadline_ - steady_clock::now()));
}

// Makes the entry's next call to the history. This is the only place that decides whether a write is done, is tried
// again later or is dropped.
LearnerMemory::WriteResult LearnerMemory::try_write(PendingWrite& entry) {
  write_time_ = entry.at;
  history_->set_lock_timeout(std::exchange(is_locked_, false) ? kNoWait : current_lock_timeout());
  WriteResult result = WriteResult::retry;
  try {
    std::visit([&](auto& what) { write(entry, what); }, entry.what);
    result = WriteResult::done;
    entry.failures = 0;
    is_usable_ = true;
    is_disk_full_ = false;
    reported_.clear();
  } catch (const HistoryDeleted&) {
    result = WriteResult::dropped;
    entry.owner->deleted = true;
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
    if (++entry.failures >= kMaxFailures) result = WriteResult::failed;
  }
  if (result == WriteResult::retry || result == WriteResult::failed) next_try_ = steady_clock::now() + kRetryInterval;
  write_time_.reset();
  return result;
}

// True if the owner's data can still be saved: there is a learner, not deleted, and a history file.
bool LearnerMemory::waits_for_history(const Person& owner) const noexcept {
  return !owner.name.empty() && !owner.deleted && !file_.empty();
}

// A run in progress waits only for its start and its new shifts, a comment only once its run has a number.
bool LearnerMemory::is_waiting(const PendingWrite& entry) const noexcept {
  if (entry.written || entry.lost || !waits_for_history(*entry.owner)) return false;
  if (const auto* run = std::get_if<PendingRun>(&entry.what))
    return run->over || run->row.id < 0 || run->shifts < run->row.result.shifts.size();
  const auto* comment = std::get_if<PendingComment>(&entry.what);
  return comment == nullptr || comment->run > 0;
}

bool LearnerMemory::has_pending() const noexcept {
  return std::any_of(pending_.begin(), pending_.end(), [this](const PendingWrite& entry) { return is_waiting(entry); });
}

// Returns text such as "2 runs, 1 comment".
std::string LearnerMemory::describe_pending() const {
  std::ptrdiff_t runs = 0, comments = 0, choices = 0, names = 0;
  each_pending<PendingRun>(pending_,
                           [&](const PendingWrite& entry, const PendingRun&) { runs += is_waiting(entry) ? 1 : 0; });
  // Counts comments on unsaved runs as well.
  each_pending<PendingComment>(pending_, [&](const PendingWrite& entry, const PendingComment&) {
    comments += !entry.lost && waits_for_history(*entry.owner) ? 1 : 0;
  });
  each_pending<PendingChoice>(
      pending_, [&](const PendingWrite& entry, const PendingChoice&) { choices += is_waiting(entry) ? 1 : 0; });
  each_pending<PendingName>(pending_,
                            [&](const PendingWrite& entry, const PendingName&) { names += is_waiting(entry) ? 1 : 0; });
  const std::string text = counted(runs, "run", "runs") + counted(comments, "comment", "comments") +
                           counted(choices, "choice of the next lesson", "choices of the next lesson") +
                           counted(names, "new name", "new names");
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

// Writes in order, so an entry that cannot be written yet delays all later entries, until it has failed kMaxFailures
// times. Returns true if anything was written, or if data of a deleted learner was dropped.
bool LearnerMemory::write_pending(Moment until) {
  if (!history_ || !has_pending()) return false;
  bool any = false, keeps_going = true;
  std::vector<PendingWrite*> failed;
  for (PendingWrite& entry : pending_) {
    WriteResult result = WriteResult::done;
    while (keeps_going && result != WriteResult::failed && is_waiting(entry)) {
      result = try_write(entry);
      if (result == WriteResult::failed) failed.push_back(&entry);
      any = any || result == WriteResult::done;
      keeps_going = result != WriteResult::retry && steady_clock::now() < until;
    }
  }
  if (any) give_up(failed);
  std::erase_if(pending_, is_written);
  return drop_deleted() || any;
}

// Gives up entries that failed although others could be written: the fault is theirs, not the file's. They stay visible
// in this session.
void LearnerMemory::give_up(std::span<PendingWrite* const> failed) {
  static constexpr std::array kWhat{"a run", "a comment", "the choice of the next lesson", "a new name",
                                    "the removal of a recording"};
  static_assert(kWhat.size() == std::variant_size_v<decltype(PendingWrite::what)>);
  for (PendingWrite* entry : failed) {
    entry->lost = true;
    report(fmt::format("{}; {} was dropped", reason_, kWhat[entry->what.index()]));
  }
}

// Writes the start of the run, then each new shift or, once the run is over, its result with all shifts.
void LearnerMemory::write(PendingWrite& entry, PendingRun& run) {
  if (run.row.id < 0) {
    run.row.session = session_for(entry.owner);
    renumber(run, history_->begin_run(run.row.session, run.row.result, run.row.recording));
  } else if (run.over) {
    history_->end_run(run.row.id, run.row.result);
    entry.written = true;
  } else {
    history_->add_shift(run.row.id, run.row.result.shifts[run.shifts]);
    ++run.shifts;
  }
}

// Adds, edits or deletes a comment in the history and in its run. If another program has deleted the comment, it stays
// deleted.
void LearnerMemory::write(PendingWrite& entry, PendingComment& comment) {
  CommentRow& row = comment.row;
  const bool is_new = row.id < 0;
  if (is_new)
    row.id = history_->add_comment(comment.run, row.author, row.text);
  else if (comment.deleted)
    history_->delete_comment(row.id);
  else
    comment.deleted = !history_->edit_comment(row.id, row.text);
  entry.written = true;
  for (RunRow& run : runs_) {
    if (run.id != comment.run) continue;
    if (is_new)
      run.comments.push_back(row);
    else
      apply(comment, run.comments);
  }
}

void LearnerMemory::write(PendingWrite& entry, const PendingChoice& choice) {
  history_->set_next_lesson(id_for(*entry.owner), choice.lesson);
  entry.written = true;
}

void LearnerMemory::write(PendingWrite& entry, const PendingName& name) {
  if (!history_->rename_learner(entry.owner->id, name.name)) {
    entry.owner->name = name.before;
    report(fmt::format("Another learner is called {} now, so the name {} stays.", haptics::printable(name.name),
                       haptics::printable(name.before)));
  }
  entry.written = true;
}

void LearnerMemory::write(PendingWrite& entry, const PendingRemoval& removal) {
  history_->clear_recording(removal.run);
  entry.written = true;
}

void LearnerMemory::renumber(PendingRun& run, std::int64_t number) {
  const std::int64_t before = std::exchange(run.row.id, number);
  for (RunRow& row : runs_) {
    if (row.id == before) row = run.row;
  }
  each_pending<PendingComment>(pending_, [&](const PendingWrite&, PendingComment& comment) {
    if (comment.run == before) comment.run = number;
  });
  if (last_run_ == before) last_run_ = number;
}

std::int64_t LearnerMemory::session_for(const PersonPtr& owner) {
  if (!session_ || session_->owner != owner) {
    session_.reset();
    session_ = DrivingSession{owner, history_->begin_session(id_for(*owner), program_)};
  }
  return session_->id;
}

// Returns the learner's number in the history. Creates the learner if it has none yet. A deleted learner keeps the old
// number, so that writes for that learner fail.
std::int64_t LearnerMemory::id_for(Person& person) {
  if (person.id == 0) person.id = history_->find_or_add_learner(person.name);
  return person.id;
}

}  // namespace gearshift::lessons
