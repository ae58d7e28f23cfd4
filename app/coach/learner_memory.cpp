#include "app/coach/learner_memory.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace gearshift {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kApart{500};     // between two tries in a row of frames
constexpr milliseconds kLongest{50};    // of one frame, for all that waits
constexpr milliseconds kNoPatience{0};  // for who holds the file already

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
  settle();
}

void LearnerMemory::open(milliseconds patience) {
  if (history_ || file_.empty()) return;
  const auto date = [this] { return writing_of_.value_or(now_()); };
  try {
    history_ = std::make_unique<History>(file_, date, patience);
    works_ = true;
    told_.clear();
  } catch (const HistoryError& problem) {
    tell(problem.what());
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

template <class Work>
LearnerMemory::Given LearnerMemory::give(std::int64_t at, const Work& work) {
  writing_of_ = at;
  history_->set_patience(std::exchange(is_held_, false) ? kNoPatience : patience_);
  Given given = Given::waits;
  try {
    work();
    given = Given::taken;
    works_ = true;
    told_.clear();
  } catch (const HistoryBusy& problem) {
    is_held_ = true;
    next_try_ = steady_clock::now() + kApart;
    tell(std::string(problem.what()) + "; what is to be remembered waits for that");
  } catch (const HistoryGone& problem) {
    given = Given::lost;
    session_.reset();
    tell(problem.what());
  } catch (const HistoryError& problem) {
    works_ = false;
    next_try_ = steady_clock::now() + kApart;
    tell(problem.what());
  }
  writing_of_.reset();
  return given;
}

std::optional<std::string> LearnerMemory::take_problem() {
  return std::exchange(problem_, std::nullopt);
}

std::vector<std::string> LearnerMemory::learners() {
  std::vector<std::string> names{learner_};
  read([&] {
    for (const LearnerRow& row : history_->learners()) names.push_back(row.name);
  });
  for (const KeptRun& run : kept_) names.push_back(run.learner);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::erase(names, "");
  return names;
}

void LearnerMemory::set_learner(const std::string& name) {
  learner_ = name;
  runs_.clear();
  next_.clear();
  load();
}

void LearnerMemory::look_again() {
  if (!history_) {
    open(patience_);
    if (history_) load();
  }
  bool changed = false;
  read([&] { changed = history_->changes() != changes_; });
  if (changed) load();
}

// What cannot be read stays as it was, until the next look.
void LearnerMemory::load() {
  changes_.reset();
  read([&] {
    const std::int64_t changes = history_->changes();
    LearnerRow row;
    if (!learner_.empty()) row = history_->find_learner(learner_).value_or(LearnerRow{});
    std::vector<RunRow> runs;
    if (row.id != 0) runs = history_->runs(row.id);
    if (session_ && session_->learner == learner_ && session_->learner_id != row.id) session_.reset();
    runs_ = std::move(runs);
    next_ = row.next_lesson;
    changes_ = changes;
  });
  for (const KeptRun& run : kept_) {
    if (run.over && run.learner == learner_) add_kept(runs_, run.row);
  }
  if (const auto kept = kept_next_.find(learner_); kept != kept_next_.end()) next_ = kept->second.lesson;
}

std::vector<CommentRow> LearnerMemory::comments(std::int64_t run) {
  std::vector<CommentRow> all;
  if (run > 0) read([&] { all = history_->comments(run); });
  for (const KeptComment& kept : kept_comments_) {
    if (kept.run == run) all.push_back(kept.row);
  }
  return all;
}

void LearnerMemory::add_comment(std::int64_t run, const std::string& author, const std::string& text) {
  const std::int64_t now = now_();
  kept_comments_.push_back({run, now, {date_text(now), author, text}});
  write_kept(steady_clock::now() + kLongest);
}

void LearnerMemory::set_next_lesson(const std::string& lesson) {
  next_ = lesson;
  kept_next_[learner_] = {now_(), lesson};
  write_kept(steady_clock::now() + kLongest);
}

void LearnerMemory::begin_run(const LessonResult& result, const std::string& settings, const std::string& recording) {
  KeptRun run;
  run.learner = learner_;
  run.settings = settings;
  run.at = now_();
  run.row = {--last_kept_, 0, date_text(run.at), recording, result};
  run.row.result.shifts.clear();
  run.lost = learner_.empty() || file_.empty();
  last_run_ = run.row.id;
  kept_.push_back(std::move(run));
  in_run_ = true;
  write_kept(steady_clock::now() + kLongest);
}

void LearnerMemory::add_shift(const ShiftRecord& shift) {
  kept_.back().row.result.shifts.push_back(shift);
  write_kept(steady_clock::now() + kLongest);
}

void LearnerMemory::end_run(const LessonResult& result) {
  KeptRun& run = kept_.back();
  run.row.result = result;
  run.over = true;
  in_run_ = false;
  add_kept(runs_, run.row);
  write_kept(steady_clock::now() + kLongest);
}

std::int64_t LearnerMemory::run_number() const noexcept {
  const auto kept =
      std::find_if(kept_.begin(), kept_.end(), [&](const KeptRun& run) { return run.row.id == last_run_; });
  if (kept == kept_.end()) return last_run_;
  const bool has_all = !kept->over && !kept->lost && kept->shifts == kept->row.result.shifts.size();
  return has_all && last_run_ > 0 ? last_run_ : 0;
}

bool LearnerMemory::is_waiting(const KeptRun& run) noexcept {
  return !run.lost && !run.written && (run.over || run.row.id < 0 || run.shifts < run.row.result.shifts.size());
}

// One on a run that the history does not know waits for that.
bool LearnerMemory::is_waiting(const KeptComment& comment) noexcept {
  return !comment.lost && !comment.written && comment.run > 0;
}

bool LearnerMemory::anything_waits() const noexcept {
  const auto waits = [](const auto& kept) { return is_waiting(kept); };
  return std::any_of(kept_.begin(), kept_.end(), waits) ||
         std::any_of(kept_comments_.begin(), kept_comments_.end(), waits) ||
         std::any_of(kept_next_.begin(), kept_next_.end(), [](const auto& kept) { return !kept.first.empty(); });
}

bool LearnerMemory::try_again() {
  const Moment now = steady_clock::now();
  return now >= next_try_ && write_kept(now + kLongest);
}

void LearnerMemory::settle() {
  if (!history_ || !anything_waits()) return;
  is_held_ = false;
  const milliseconds usual = std::exchange(patience_, kHistoryPatience);
  write_kept(Moment::max());
  patience_ = usual;
}

// In order: what comes first holds up what comes after it. Returns whether anything was taken.
bool LearnerMemory::write_kept(Moment until) {
  if (!history_ || !anything_waits()) return false;
  bool any = false, goes_on = true;
  const auto take = [&](auto& kept) {
    if (!goes_on || !is_waiting(kept)) return;
    const Given given = write(kept);
    kept.lost = given == Given::lost;
    any = any || given == Given::taken;
    goes_on = given != Given::waits && steady_clock::now() < until;
  };
  for (KeptRun& run : kept_) take(run);
  for (KeptComment& comment : kept_comments_) take(comment);
  std::erase_if(kept_, [](const KeptRun& run) { return run.written; });
  std::erase_if(kept_comments_, [](const KeptComment& comment) { return comment.written; });
  for (auto next = kept_next_.begin(); goes_on && next != kept_next_.end();) {
    const bool taken = !next->first.empty() && write_next(next->first, next->second) == Given::taken;
    any = any || taken;
    next = taken ? kept_next_.erase(next) : std::next(next);
  }
  return any;
}

// Its begin, its shifts, its end: as far as it is known, and the history does not have it.
LearnerMemory::Given LearnerMemory::write(KeptRun& run) {
  const std::vector<ShiftRecord>& shifts = run.row.result.shifts;
  Given given = Given::taken;
  if (run.row.id < 0) given = give(run.at, [&] { begin(run); });
  while (given == Given::taken && !run.over && run.shifts < shifts.size()) {
    given = give(run.at, [&] { history_->add_shift(run.row.id, shifts[run.shifts]); });
    if (given == Given::taken) ++run.shifts;
  }
  if (given != Given::taken || !run.over) return given;
  given = give(run.at, [&] { history_->end_run(run.row.id, run.row.result); });
  run.written = given == Given::taken;
  return given;
}

LearnerMemory::Given LearnerMemory::write(KeptComment& comment) {
  const Given given =
      give(comment.at, [&] { history_->add_comment(comment.run, comment.row.author, comment.row.text); });
  comment.written = given == Given::taken;
  return given;
}

LearnerMemory::Given LearnerMemory::write_next(const std::string& learner, const KeptNext& next) {
  return give(next.at, [&] { history_->set_next_lesson(history_->learner(learner), next.lesson); });
}

void LearnerMemory::begin(KeptRun& run) {
  run.row.session = session_of(run);
  const std::int64_t number = history_->begin_run(run.row.session, run.row.result, run.row.recording);
  const std::int64_t before = std::exchange(run.row.id, number);
  for (RunRow& row : runs_) {
    if (row.id == before) row = run.row;
  }
  for (KeptComment& comment : kept_comments_) {
    if (comment.run == before) comment.run = number;
  }
  if (last_run_ == before) last_run_ = number;
}

std::int64_t LearnerMemory::session_of(const KeptRun& run) {
  if (!session_ || session_->learner != run.learner) {
    session_.reset();
    const std::int64_t learner = history_->learner(run.learner);
    session_ = DrivingSession{run.learner, learner, history_->begin_session(learner, program_), std::nullopt};
  }
  if (session_->settings != run.settings) history_->add_settings(session_->id, run.settings);
  session_->settings = run.settings;
  return session_->id;
}

std::vector<std::string> LearnerMemory::forget_recordings() {
  std::vector<std::string> files;
  for (KeptRun& run : kept_) {
    if (run.row.id < 0 && !run.row.recording.empty()) files.push_back(std::exchange(run.row.recording, ""));
  }
  return files;
}

}  // namespace gearshift
