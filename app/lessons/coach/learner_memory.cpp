#include "app/lessons/coach/learner_memory.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

using std::chrono::milliseconds;

// Finds a learner by number, because a learner with the same name may be a different person. If the number is unknown,
// finds the learner by name. Returns a row with number 0 if there is no such learner.
template <class Person>
LearnerRow row_of(std::vector<LearnerRow> rows, const Person& person) {
  for (LearnerRow& row : rows) {
    const bool same = person.id != 0 ? row.id == person.id : !person.name.empty() && row.name == person.name;
    if (same) return std::move(row);
  }
  return {};
}

// Adds a pending run to `runs`. Replaces the row of the same run, except its comments, if it is partly saved, otherwise
// inserts the run by date.
void merge_pending(std::vector<RunRow>& runs, const RunRow& pending) {
  const auto same = std::find_if(runs.begin(), runs.end(), [&](const RunRow& run) { return run.id == pending.id; });
  if (same != runs.end()) {
    std::vector<CommentRow> comments = std::move(same->comments);
    *same = pending;
    same->comments = std::move(comments);
    return;
  }
  const auto later =
      std::find_if(runs.begin(), runs.end(), [&](const RunRow& run) { return run.begun_at > pending.begun_at; });
  runs.insert(later, pending);
}

}  // namespace

LearnerMemory::LearnerMemory(const std::filesystem::path& history, std::string program, Clock now,
                             milliseconds lock_timeout)
    : file_(history), program_(std::move(program)), now_(std::move(now)), lock_timeout_(lock_timeout) {
  open(kHistoryLockTimeout);
}

LearnerMemory::~LearnerMemory() {
  try {
    if (!flush_failed_) flush();
  } catch (const std::exception&) {
    // Only a lack of memory arrives here, since flush() reports what a history refuses. A destructor must not throw.
  }
}

void LearnerMemory::open(milliseconds lock_timeout) {
  if (history_ || file_.empty()) return;
  const auto date = [this] { return write_time_.value_or(now_()); };
  try {
    history_ = std::make_unique<History>(file_, date, lock_timeout);
    is_usable_ = true;
    is_disk_full_ = false;
    reported_.clear();
    if (!history_->upgrade_note().empty()) report(history_->upgrade_note());
  } catch (const HistoryFull& problem) {
    is_disk_full_ = true;
    reason_ = problem.what();
    report(waiting_message_ = reason_ + kWaitsForRoom);
  } catch (const HistoryError& problem) {
    reason_ = problem.what();
    report(reason_);
  }
}

// Reports a problem. Repeats the same sentence only if the history has saved something in between.
void LearnerMemory::report(const std::string& problem) {
  if (problem != reported_) problem_ = reported_ = problem;
}

template <class Work>
bool LearnerMemory::read(const Work& work) {
  if (!history_) return false;
  history_->set_lock_timeout(std::exchange(is_read_blocked_, true) ? kNoWait : lock_timeout_);
  try {
    work();
    is_read_blocked_ = false;
    return true;
  } catch (const HistoryBusy&) {  // the data of the last successful read stays in use
  } catch (const HistoryError& problem) {
    is_usable_ = false;
    report(problem.what());
  }
  return false;
}

std::optional<std::string> LearnerMemory::take_problem() {
  return std::exchange(problem_, std::nullopt);
}

std::vector<std::string> LearnerMemory::learners() {
  std::vector<std::string> names;
  if (!person_->deleted) names.push_back(person_->name);
  read([&] {
    for (const LearnerRow& row : history_->learners()) names.push_back(row.name);
  });
  each_pending<PendingRun>(pending_, [&](const PendingWrite& entry, const PendingRun&) {
    if (!entry.owner->deleted) names.push_back(entry.owner->name);
  });
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::erase(names, "");
  return names;
}

std::optional<std::string> LearnerMemory::known_name(const std::string& typed) {
  const std::vector<std::string> names = learners();
  const std::optional<std::size_t> found = find_name(names, typed);
  return found ? std::optional(names[*found]) : std::nullopt;
}

void LearnerMemory::rename_learner(const std::string& name) {
  std::string before = std::exchange(person_->name, name);
  if (person_->id == 0) return;  // the name is saved with the first run
  std::erase_if(pending_, [&](const PendingWrite& entry) {
    const auto* pending = std::get_if<PendingName>(&entry.what);
    if (pending == nullptr || entry.owner != person_) return false;
    before = pending->before;
    return true;
  });
  pending_.push_back({person_, now_(), PendingName{before, name}});
  write_now();
}

bool LearnerMemory::has_pending_name(const PersonPtr& person) const noexcept {
  return std::any_of(pending_.begin(), pending_.end(), [&](const PendingWrite& entry) {
    return entry.owner == person && std::holds_alternative<PendingName>(entry.what);
  });
}

// Returns the learner that was selected earlier under this name, otherwise a new learner.
LearnerMemory::PersonPtr LearnerMemory::find_or_add_person(const std::string& name) {
  const auto known = std::find_if(people_.begin(), people_.end(),
                                  [&](const PersonPtr& person) { return person->name == name && !person->deleted; });
  if (known != people_.end()) return *known;
  people_.push_back(std::make_shared<Person>(Person{name}));
  return people_.back();
}

void LearnerMemory::set_learner(const std::string& name) {
  person_ = find_or_add_person(name);
  runs_.clear();
  next_.clear();
  load();
  if (person_->deleted) {  // deleted since the last selection: add a new learner
    person_ = find_or_add_person(name);
    load();
  }
  drop_deleted();
}

void LearnerMemory::reload() {
  if (!history_) {
    open(lock_timeout_);
    if (history_) load();
  }
  bool changed = false;
  read([&] { changed = history_->changes() != changes_; });
  if (changed) load();
  drop_deleted();
}

// Loads the learner's data. If reading fails, the data of the last successful read stays in use until the next attempt.
void LearnerMemory::load() {
  changes_.reset();
  if (person_->deleted) runs_.clear(), next_.clear();
  read([&] {
    const std::int64_t changes = history_->changes();
    const std::vector<LearnerRow> rows = history_->learners();
    for (const PersonPtr& person : people_) {  // another program may have renamed a learner
      const LearnerRow row = row_of(rows, *person);
      if (row.id != 0 && !has_pending_name(person)) person->name = row.name;
    }
    const LearnerRow row = row_of(rows, *person_);
    if (row.id == 0 && person_->id != 0) person_->deleted = true;
    std::vector<RunRow> runs;
    if (row.id != 0) runs = history_->runs(row.id);
    for (RunRow& run : runs) run.recording = history_->recording_file(run.recording).string();
    if (row.id != 0) person_->id = row.id;
    runs_ = std::move(runs);
    next_ = row.next_lesson;
    changes_ = changes;
  });
  each_pending<PendingRun>(pending_, [&](const PendingWrite& entry, const PendingRun& run) {
    if (run.over && entry.owner == person_) merge_pending(runs_, run.row);
  });
  each_pending<PendingChoice>(pending_, [&](const PendingWrite& entry, const PendingChoice& choice) {
    if (entry.owner == person_) next_ = choice.lesson;
  });
}

// Returns true if a learner was deleted.
bool LearnerMemory::drop_deleted() {
  const auto is_deleted = [](const PersonPtr& person) { return person->deleted; };
  const bool any = std::any_of(people_.begin(), people_.end(), is_deleted);
  for (const PersonPtr& person : std::exchange(people_, {})) {
    if (!person->deleted) {
      people_.push_back(person);
      continue;
    }
    const bool waited = drop_pending_of(person);
    if (person == person_) load();
    if (waited && person != person_)
      report("Another program deleted " + haptics::printable(person->name) + ", so the unsaved results were dropped.");
  }
  if (any && person_->deleted)
    report("Another program deleted " + haptics::printable(person_->name) +
           ", so this session is no longer saved. Choose or enter a learner to continue.");
  return any;
}

// Drops a deleted learner's pending writes. The current or last run stays visible but is never saved. Returns true if
// results were pending.
bool LearnerMemory::drop_pending_of(const PersonPtr& person) {
  each_pending<PendingRun>(pending_, [&](const PendingWrite& entry, PendingRun& run) {
    if (entry.owner != person) return;
    if (!run.row.recording.empty()) unreferenced_recordings_.push_back(std::exchange(run.row.recording, ""));
    renumber(run, --last_local_id_);
  });
  bool any = false;
  std::erase_if(pending_, [&](const PendingWrite& entry) {
    const auto* run = std::get_if<PendingRun>(&entry.what);
    const bool drops = entry.owner == person && (run == nullptr || run->row.id != last_run_);
    any = any || (drops && !std::holds_alternative<PendingRemoval>(entry.what));
    return drops;
  });
  return any;
}

std::vector<CommentRow> LearnerMemory::comments(std::int64_t run) const {
  std::vector<CommentRow> all;
  for (const RunRow& row : runs_) {
    if (row.id == run) all = row.comments;
  }
  each_pending<PendingComment>(pending_, [&](const PendingWrite&, const PendingComment& pending) {
    if (pending.run != run) return;
    if (pending.row.id < 0)
      all.push_back(pending.row);
    else
      apply(pending, all);
  });
  return all;
}

// Edits or deletes the comment if it is in the list.
void LearnerMemory::apply(const PendingComment& change, std::vector<CommentRow>& comments) {
  const auto same =
      std::find_if(comments.begin(), comments.end(), [&](const CommentRow& row) { return row.id == change.row.id; });
  if (same == comments.end()) return;
  if (change.deleted)
    comments.erase(same);
  else
    same->text = change.row.text, same->edited_at = change.row.edited_at;
}

void LearnerMemory::add_comment(std::int64_t run, const std::string& author, const std::string& text) {
  const std::int64_t now = now_();
  pending_.push_back({person_, now, PendingComment{run, {format_utc(now), author, text, --last_local_id_}}});
  write_now();
}

void LearnerMemory::edit_comment(std::int64_t run, std::int64_t comment, const std::string& text) {
  PendingWrite& entry = find_or_add_comment(run, comment);
  CommentRow& row = std::get<PendingComment>(entry.what).row;
  row.text = text;
  if (comment > 0) entry.at = now_(), row.edited_at = format_utc(entry.at);
  write_now();
}

void LearnerMemory::delete_comment(std::int64_t run, std::int64_t comment) {
  PendingWrite& entry = find_or_add_comment(run, comment);
  std::get<PendingComment>(entry.what).deleted = true;
  entry.written = comment < 0;  // a comment that was never saved needs no write
  std::erase_if(pending_, is_written);
  write_now();
}

// The pending entry of the comment. A saved comment has none until it is changed again.
LearnerMemory::PendingWrite& LearnerMemory::find_or_add_comment(std::int64_t run, std::int64_t comment) {
  for (PendingWrite& entry : pending_) {
    const auto* pending = std::get_if<PendingComment>(&entry.what);
    if (pending != nullptr && pending->row.id == comment) return entry;
  }
  return pending_.emplace_back(PendingWrite{person_, now_(), PendingComment{run, {{}, {}, {}, comment}}});
}

void LearnerMemory::set_next_lesson(const std::string& lesson) {
  next_ = lesson;
  std::erase_if(pending_, [&](const PendingWrite& entry) {
    return entry.owner == person_ && std::holds_alternative<PendingChoice>(entry.what);
  });
  pending_.push_back({person_, now_(), PendingChoice{lesson}});
  write_now();
}

void LearnerMemory::begin_run(const LessonResult& result, const std::string& recording) {
  const std::int64_t now = now_();
  PendingRun run{{--last_local_id_, 0, format_utc(now), recording, result}};
  run.row.result.shifts.clear();
  last_run_ = run.row.id;
  pending_.push_back({person_, now, std::move(run)});
  in_run_ = true;
  write_now();
}

// The run in progress; it stays pending until it is over.
LearnerMemory::PendingWrite& LearnerMemory::current_run() noexcept {
  PendingWrite* current = nullptr;
  each_pending<PendingRun>(pending_, [&](PendingWrite& entry, const PendingRun&) { current = &entry; });
  return *current;
}

void LearnerMemory::add_shift(const ShiftRecord& shift) {
  std::get<PendingRun>(current_run().what).row.result.shifts.push_back(shift);
  write_now();
}

void LearnerMemory::end_run(const LessonResult& result) {
  PendingWrite& entry = current_run();
  PendingRun& run = std::get<PendingRun>(entry.what);
  run.row.result = result;
  run.over = true;
  in_run_ = false;
  if (entry.owner == person_) merge_pending(runs_, run.row);
  write_now();
}

// Removes the recording's path from the current or last run. If the run is not in the history yet, the path is never
// written.
void LearnerMemory::clear_recording() {
  for (RunRow& row : runs_) {
    if (row.id == last_run_) row.recording.clear();
  }
  PersonPtr owner = person_;
  each_pending<PendingRun>(pending_, [&](const PendingWrite& entry, PendingRun& run) {
    if (run.row.id != last_run_) return;
    run.row.recording.clear();
    owner = entry.owner;
  });
  if (last_run_ > 0) pending_.push_back({owner, now_(), PendingRemoval{last_run_}});
  write_now();
}

std::int64_t LearnerMemory::run_number() const noexcept {
  bool has_all = true;
  each_pending<PendingRun>(pending_, [&](const PendingWrite&, const PendingRun& run) {
    if (run.row.id == last_run_) has_all = !run.over && run.shifts == run.row.result.shifts.size();
  });
  return has_all ? std::max<std::int64_t>(last_run_, 0) : 0;
}

std::vector<std::string> LearnerMemory::take_unreferenced_recordings() {
  std::vector<std::string> files = std::exchange(unreferenced_recordings_, {});
  each_pending<PendingRun>(pending_, [&](const PendingWrite&, PendingRun& run) {
    if (run.row.id < 0 && !run.row.recording.empty()) files.push_back(std::exchange(run.row.recording, ""));
  });
  return files;
}

}  // namespace gearshift::lessons
