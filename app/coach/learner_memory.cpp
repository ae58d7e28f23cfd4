#include "app/coach/learner_memory.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift {
namespace {

using std::chrono::milliseconds;

// Who was known here is found by number: another one of that name is somebody else. None: number 0.
template <class Person>
LearnerRow row_of(std::vector<LearnerRow> rows, const Person& person) {
  for (LearnerRow& row : rows) {
    const bool same = person.id != 0 ? row.id == person.id : !person.name.empty() && row.name == person.name;
    if (same) return std::move(row);
  }
  return {};
}

// One that the history knows only the beginning of takes its place; the others come where their date puts them.
void add_kept(std::vector<RunRow>& runs, const RunRow& kept) {
  const auto same = std::find_if(runs.begin(), runs.end(), [&](const RunRow& run) { return run.id == kept.id; });
  if (same != runs.end()) {
    *same = kept;
    return;
  }
  const auto later =
      std::find_if(runs.begin(), runs.end(), [&](const RunRow& run) { return run.begun_at > kept.begun_at; });
  runs.insert(later, kept);
}

}  // namespace

LearnerMemory::LearnerMemory(const std::filesystem::path& history, std::string program, Clock now,
                             milliseconds patience)
    : file_(history), program_(std::move(program)), now_(std::move(now)), patience_(patience) {
  open(kHistoryPatience);
}

LearnerMemory::~LearnerMemory() {
  if (!gave_up_) settle();
}

void LearnerMemory::open(milliseconds patience) {
  if (history_ || file_.empty()) return;
  const auto date = [this] { return writing_of_.value_or(now_()); };
  try {
    history_ = std::make_unique<History>(file_, date, patience);
    works_ = true;
    is_full_ = false;
    told_.clear();
  } catch (const HistoryFull& problem) {
    is_full_ = true;
    why_ = problem.what();
    tell(promise_ = why_ + kWaitsForRoom);
  } catch (const HistoryError& problem) {
    why_ = problem.what();
    tell(why_);
  }
}

// The same sentence is not told again before the history has taken something.
void LearnerMemory::tell(const std::string& problem) {
  if (problem != told_) problem_ = told_ = problem;
}

template <class Work>
bool LearnerMemory::read(const Work& work) {
  if (!history_) return false;
  history_->set_patience(std::exchange(cannot_read_, true) ? kNoPatience : patience_);
  try {
    work();
    cannot_read_ = false;
    return true;
  } catch (const HistoryBusy&) {  // seldom: what was read before stays until the next look
  } catch (const HistoryError& problem) {
    works_ = false;
    tell(problem.what());
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
  for (const KeptRun& run : kept_) {
    if (!run.of->deleted) names.push_back(run.of->name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::erase(names, "");
  return names;
}

// Who was chosen before, or somebody new of that name.
LearnerMemory::PersonHere LearnerMemory::person_called(const std::string& name) {
  const auto known = std::find_if(people_.begin(), people_.end(),
                                  [&](const PersonHere& person) { return person->name == name && !person->deleted; });
  if (known != people_.end()) return *known;
  people_.push_back(std::make_shared<Person>(Person{name}));
  return people_.back();
}

void LearnerMemory::set_learner(const std::string& name) {
  person_ = person_called(name);
  runs_.clear();
  next_.clear();
  load();
  if (person_->deleted) {  // since it was chosen before: it is another one now
    person_ = person_called(name);
    load();
  }
  drop_deleted();
}

void LearnerMemory::look_again() {
  if (!history_) {
    open(patience_);
    if (history_) load();
  }
  bool changed = false;
  read([&] { changed = history_->changes() != changes_; });
  if (changed) load();
  drop_deleted();
}

// What cannot be read stays as it was, until the next look.
void LearnerMemory::load() {
  changes_.reset();
  if (person_->deleted) runs_.clear(), next_.clear();
  read([&] {
    const std::int64_t changes = history_->changes();
    const LearnerRow row = row_of(history_->learners(), *person_);
    if (row.id == 0 && person_->id != 0) person_->deleted = true;
    std::vector<RunRow> runs;
    if (row.id != 0) runs = history_->runs(row.id);
    for (RunRow& run : runs) run.recording = history_->recording_file(run.recording).string();
    if (row.id != 0) person_->id = row.id;
    runs_ = std::move(runs);
    next_ = row.next_lesson;
    changes_ = changes;
  });
  for (const KeptRun& run : kept_) {
    if (run.over && run.of == person_) add_kept(runs_, run.row);
  }
  for (const KeptNext& next : kept_next_) {
    if (next.of == person_) next_ = next.lesson;
  }
}

// True: somebody was.
bool LearnerMemory::drop_deleted() {
  const auto is_deleted = [](const PersonHere& person) { return person->deleted; };
  const bool any = std::any_of(people_.begin(), people_.end(), is_deleted);
  for (const PersonHere& gone : std::exchange(people_, {})) {
    if (!gone->deleted) {
      people_.push_back(gone);
      continue;
    }
    const bool waited = drop_what_is_of(gone);
    if (gone == person_) load();
    if (waited && gone != person_)
      tell(printable(gone->name) + " was deleted by another program: what waited to be remembered is dropped.");
  }
  if (any && person_->deleted)
    tell(printable(person_->name) +
         " was deleted by another program: this session is not remembered any more; choose or enter a learner to go "
         "on.");
  return any;
}

// The run that is driven, or was last, stays in sight and is nobody's. True: something waited.
bool LearnerMemory::drop_what_is_of(const PersonHere& gone) {
  const std::size_t before = kept_.size() + kept_comments_.size() + kept_next_.size();
  for (KeptRun& run : kept_) {
    if (run.of != gone) continue;
    if (!run.row.recording.empty()) forgotten_recordings_.push_back(std::exchange(run.row.recording, ""));
    renumber(run, --last_kept_);
  }
  const auto is_gone = [&](const auto& kept) { return kept.of == gone; };
  std::erase_if(kept_, [&](const KeptRun& run) { return is_gone(run) && run.row.id != last_run_; });
  std::erase_if(kept_comments_, is_gone);
  std::erase_if(kept_next_, is_gone);
  std::erase_if(kept_losses_, is_gone);
  return kept_.size() + kept_comments_.size() + kept_next_.size() < before;
}

std::vector<CommentRow> LearnerMemory::comments(std::int64_t run) {
  std::vector<CommentRow> all;
  if (run > 0) read([&] { all = history_->comments(run); });
  for (const KeptComment& kept : kept_comments_) {
    if (kept.run != run) continue;
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const CommentRow& row) { return row.id == kept.row.id; });
    if (kept.row.id < 0)
      all.push_back(kept.row);
    else if (same != all.end() && kept.taken_back)
      all.erase(same);
    else if (same != all.end())
      same->text = kept.row.text, same->edited_at = kept.row.edited_at;
  }
  return all;
}

void LearnerMemory::add_comment(std::int64_t run, const std::string& author, const std::string& text) {
  const std::int64_t now = now_();
  kept_comments_.push_back({person_, run, now, {date_text(now), author, text, --last_kept_}});
  write_now();
}

// One that the history does not have yet is simply said so.
void LearnerMemory::edit_comment(std::int64_t run, std::int64_t comment, const std::string& text) {
  const std::int64_t now = now_();
  KeptComment* kept = kept_comment(comment);
  if (!kept) kept = &kept_comments_.emplace_back(KeptComment{person_, run, now, {{}, {}, {}, comment}});
  kept->row.text = text;
  if (comment > 0) kept->at = now, kept->row.edited_at = date_text(now);
  write_now();
}

void LearnerMemory::delete_comment(std::int64_t run, std::int64_t comment) {
  KeptComment* kept = kept_comment(comment);
  if (comment < 0) {
    std::erase_if(kept_comments_, [&](const KeptComment& each) { return each.row.id == comment; });
    return;
  }
  if (!kept) kept = &kept_comments_.emplace_back(KeptComment{person_, run, now_(), {{}, {}, {}, comment}});
  kept->taken_back = true;
  write_now();
}

LearnerMemory::KeptComment* LearnerMemory::kept_comment(std::int64_t comment) noexcept {
  const auto kept = std::find_if(kept_comments_.begin(), kept_comments_.end(),
                                 [&](const KeptComment& each) { return each.row.id == comment; });
  return kept == kept_comments_.end() ? nullptr : &*kept;
}

void LearnerMemory::set_next_lesson(const std::string& lesson) {
  next_ = lesson;
  std::erase_if(kept_next_, [&](const KeptNext& next) { return next.of == person_; });
  kept_next_.push_back({person_, now_(), lesson});
  write_now();
}

void LearnerMemory::begin_run(const LessonResult& result, const std::string& settings, const std::string& recording) {
  KeptRun run;
  run.of = person_;
  run.settings = settings;
  run.at = now_();
  run.row = {--last_kept_, 0, date_text(run.at), recording, result};
  run.row.result.shifts.clear();
  last_run_ = run.row.id;
  kept_.push_back(std::move(run));
  in_run_ = true;
  write_now();
}

void LearnerMemory::add_shift(const ShiftRecord& shift) {
  kept_.back().row.result.shifts.push_back(shift);
  write_now();
}

void LearnerMemory::end_run(const LessonResult& result) {
  KeptRun& run = kept_.back();
  run.row.result = result;
  run.over = true;
  in_run_ = false;
  if (run.of == person_) add_kept(runs_, run.row);
  write_now();
}

// What the history does not know yet it never hears of.
void LearnerMemory::forget_recording() {
  for (RunRow& row : runs_) {
    if (row.id == last_run_) row.recording.clear();
  }
  PersonHere of = person_;
  for (KeptRun& run : kept_) {
    if (run.row.id != last_run_) continue;
    run.row.recording.clear();
    of = run.of;
  }
  if (last_run_ > 0) kept_losses_.push_back({of, now_(), last_run_});
  write_now();
}

std::int64_t LearnerMemory::run_number() const noexcept {
  const auto kept =
      std::find_if(kept_.begin(), kept_.end(), [&](const KeptRun& run) { return run.row.id == last_run_; });
  if (kept == kept_.end()) return std::max<std::int64_t>(last_run_, 0);
  const bool has_all = !kept->over && kept->shifts == kept->row.result.shifts.size();
  return has_all && last_run_ > 0 ? last_run_ : 0;
}

std::vector<std::string> LearnerMemory::forget_recordings() {
  std::vector<std::string> files = std::exchange(forgotten_recordings_, {});
  for (KeptRun& run : kept_) {
    if (run.row.id < 0 && !run.row.recording.empty()) files.push_back(std::exchange(run.row.recording, ""));
  }
  return files;
}

}  // namespace gearshift
