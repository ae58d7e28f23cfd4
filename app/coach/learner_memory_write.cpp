// What the history has not taken is offered to it: in order, with patience, for who was chosen.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/coach/learner_memory.h"

namespace gearshift {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kApart{500};   // between two tries in a row of frames
constexpr milliseconds kLongest{50};  // of one frame, for all that waits

// ", 2 runs", or nothing for none.
std::string counted(std::ptrdiff_t count, const char* one, const char* many) {
  return count == 0 ? std::string() : fmt::format(", {} {}", count, count == 1 ? one : many);
}

}  // namespace

milliseconds LearnerMemory::patience_now() const {
  if (!settles_until_) return patience_;
  return std::max(kNoPatience, std::chrono::duration_cast<milliseconds>(*settles_until_ - steady_clock::now()));
}

template <class Work>
LearnerMemory::Given LearnerMemory::give(Person& of, std::int64_t at, const Work& work) {
  writing_of_ = at;
  history_->set_patience(std::exchange(is_held_, false) ? kNoPatience : patience_now());
  Given given = Given::waits;
  try {
    work();
    given = Given::taken;
    works_ = true;
    is_full_ = false;
    told_.clear();
  } catch (const HistoryGone&) {
    given = Given::lost;
    of.deleted = true;
  } catch (const HistoryBusy& problem) {
    is_held_ = true;
    why_ = problem.what();
    tell(promise_ = why_ + "; what is to be remembered waits for that");
  } catch (const HistoryFull& problem) {
    works_ = false;
    is_full_ = true;
    why_ = problem.what();
    tell(promise_ = why_ + kWaitsForRoom);
  } catch (const HistoryError& problem) {
    works_ = false;
    why_ = problem.what();
    tell(why_);
  }
  if (given == Given::waits) next_try_ = steady_clock::now() + kApart;
  writing_of_.reset();
  return given;
}

// Nobody has a place in it, nor has who was deleted.
bool LearnerMemory::waits_for_history(const Person& of) const noexcept {
  return !of.name.empty() && !of.deleted && !file_.empty();
}

bool LearnerMemory::is_waiting(const KeptRun& run) const noexcept {
  return waits_for_history(*run.of) && !run.written &&
         (run.over || run.row.id < 0 || run.shifts < run.row.result.shifts.size());
}

// One on a run that the history does not know waits for that.
bool LearnerMemory::is_waiting(const KeptComment& comment) const noexcept {
  return waits_for_history(*comment.of) && !comment.written && comment.run > 0;
}

bool LearnerMemory::is_waiting(const KeptNext& next) const noexcept {
  return waits_for_history(*next.of) && !next.written;
}

bool LearnerMemory::is_waiting(const KeptLoss& loss) const noexcept {
  return waits_for_history(*loss.of) && !loss.written;
}

bool LearnerMemory::anything_waits() const noexcept {
  const auto waits = [this](const auto& kept) { return is_waiting(kept); };
  return std::any_of(kept_.begin(), kept_.end(), waits) ||
         std::any_of(kept_comments_.begin(), kept_comments_.end(), waits) ||
         std::any_of(kept_next_.begin(), kept_next_.end(), waits) ||
         std::any_of(kept_losses_.begin(), kept_losses_.end(), waits);
}

// "2 runs, 1 comment"
std::string LearnerMemory::what_waits() const {
  const auto waits = [this](const auto& kept) { return is_waiting(kept); };
  // Comments on a run that is not written go with it.
  const auto goes = [this](const KeptComment& comment) { return waits_for_history(*comment.of) && !comment.written; };
  const std::string words =
      counted(std::count_if(kept_.begin(), kept_.end(), waits), "run", "runs") +
      counted(std::count_if(kept_comments_.begin(), kept_comments_.end(), goes), "comment", "comments") +
      counted(std::count_if(kept_next_.begin(), kept_next_.end(), waits), "choice of the next lesson",
              "choices of the next lesson");
  return words.empty() ? words : words.substr(2);
}

bool LearnerMemory::try_again() {
  const Moment now = steady_clock::now();
  return now >= next_try_ && write_kept(now + kLongest);
}

void LearnerMemory::write_now() {
  gave_up_ = false;
  write_kept(steady_clock::now() + kLongest);
}

void LearnerMemory::settle() {
  if (!anything_waits()) return;
  is_held_ = false;
  settles_until_ = steady_clock::now() + kHistoryPatience;
  open(patience_now());
  write_kept(*settles_until_);
  settles_until_.reset();
  gave_up_ = anything_waits();
  const std::string lost = what_waits();
  if (!gave_up_ && (problem_ == loss_ || problem_ == promise_)) problem_.reset();  // it was taken after all
  if (!lost.empty()) tell(loss_ = fmt::format("{}; lost with this program: {}", why_, lost));
}

// In order: what comes first holds up what comes after it. Returns whether anything was taken, or somebody forgotten.
bool LearnerMemory::write_kept(Moment until) {
  if (!history_ || !anything_waits()) return false;
  bool any = false, goes_on = true;
  const auto take = [&](auto& kept) {
    if (!goes_on || !is_waiting(kept)) return;
    const Given given = write(kept);
    any = any || given == Given::taken;
    goes_on = given != Given::waits && steady_clock::now() < until;
  };
  for (KeptRun& run : kept_) take(run);
  for (KeptComment& comment : kept_comments_) take(comment);
  for (KeptNext& next : kept_next_) take(next);
  for (KeptLoss& loss : kept_losses_) take(loss);
  const auto is_written = [](const auto& kept) { return kept.written; };
  std::erase_if(kept_, is_written);
  std::erase_if(kept_comments_, is_written);
  std::erase_if(kept_next_, is_written);
  std::erase_if(kept_losses_, is_written);
  return drop_deleted() || any;
}

// Its begin, its shifts, its end: as far as it is known, and the history does not have it.
LearnerMemory::Given LearnerMemory::write(KeptRun& run) {
  const std::vector<ShiftRecord>& shifts = run.row.result.shifts;
  Given given = Given::taken;
  if (run.row.id < 0) given = give(*run.of, run.at, [&] { begin(run); });
  while (given == Given::taken && !run.over && run.shifts < shifts.size()) {
    given = give(*run.of, run.at, [&] { history_->add_shift(run.row.id, shifts[run.shifts]); });
    if (given == Given::taken) ++run.shifts;
  }
  if (given != Given::taken || !run.over) return given;
  given = give(*run.of, run.at, [&] { history_->end_run(run.row.id, run.row.result); });
  run.written = given == Given::taken;
  return given;
}

// One that another program has taken back meanwhile stays so.
LearnerMemory::Given LearnerMemory::write(KeptComment& comment) {
  const Given given = give(*comment.of, comment.at, [&] {
    const CommentRow& row = comment.row;
    if (row.id < 0)
      history_->add_comment(comment.run, row.author, row.text);
    else if (comment.taken_back)
      history_->delete_comment(row.id);
    else
      history_->edit_comment(row.id, row.text);
  });
  comment.written = given == Given::taken;
  return given;
}

LearnerMemory::Given LearnerMemory::write(KeptNext& next) {
  const Given given = give(*next.of, next.at, [&] { history_->set_next_lesson(id_of(*next.of), next.lesson); });
  next.written = given == Given::taken;
  return given;
}

LearnerMemory::Given LearnerMemory::write(KeptLoss& loss) {
  const Given given = give(*loss.of, loss.at, [&] { history_->forget_recording(loss.run); });
  loss.written = given == Given::taken;
  return given;
}

void LearnerMemory::begin(KeptRun& run) {
  run.row.session = session_of(run);
  renumber(run, history_->begin_run(run.row.session, run.row.result, run.row.recording));
}

// All that names the run knows it by its new number.
void LearnerMemory::renumber(KeptRun& run, std::int64_t number) {
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
  if (!session_ || session_->of != run.of) {
    session_.reset();
    session_ = DrivingSession{run.of, history_->begin_session(id_of(*run.of), program_), std::nullopt};
  }
  if (session_->settings != run.settings) history_->add_settings(session_->id, run.settings);
  session_->settings = run.settings;
  return session_->id;
}

// Only who was never known there is written there: the number of who was deleted stays hers, and takes nothing.
std::int64_t LearnerMemory::id_of(Person& person) {
  if (person.id == 0) person.id = history_->learner(person.name);
  return person.id;
}

}  // namespace gearshift
