#include "app/coach/learner_memory.h"

#include <algorithm>
#include <utility>

namespace gearshift {
namespace {

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

LearnerMemory::LearnerMemory(const std::filesystem::path& history, std::string program, Clock now)
    : program_(std::move(program)), now_(std::move(now)) {
  if (history.empty()) return;
  try {
    history_ = std::make_unique<History>(history, now_);
  } catch (const HistoryError& problem) {
    problem_ = problem.what();
  }
}

// The same sentence is not told again before the history has taken something.
template <class Work>
bool LearnerMemory::read(const Work& work) {
  if (!history_) return false;
  try {
    work();
    return true;
  } catch (const HistoryError& problem) {
    works_ = false;
    session_.reset();
    if (problem.what() != told_) problem_ = told_ = problem.what();
    return false;
  }
}

template <class Work>
bool LearnerMemory::write(const Work& work) {
  if (learner_.empty() || !read(work)) return false;
  works_ = true;
  told_.clear();
  return true;
}

std::optional<std::string> LearnerMemory::take_problem() {
  return std::exchange(problem_, std::nullopt);
}

std::vector<std::string> LearnerMemory::learners() {
  std::vector<std::string> names{learner_};
  read([&] {
    for (const LearnerRow& row : history_->learners()) names.push_back(row.name);
  });
  for (const auto& [name, runs] : kept_) names.push_back(name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::erase(names, "");
  return names;
}

void LearnerMemory::set_learner(const std::string& name) {
  learner_ = name;
  session_.reset();
  load();
}

void LearnerMemory::look_again() {
  bool changed = false;
  read([&] { changed = history_->changes() != changes_; });
  if (changed) load();
}

void LearnerMemory::load() {
  runs_.clear();
  next_.clear();
  if (!learner_.empty()) {
    read([&] {
      changes_ = history_->changes();
      follow(history_->find_learner(learner_).value_or(LearnerRow{}));
    });
  }
  if (const auto kept = kept_.find(learner_); kept != kept_.end()) {
    for (const RunRow& run : kept->second) add_kept(runs_, run);
  }
  if (const auto kept = kept_next_.find(learner_); kept != kept_next_.end()) next_ = kept->second;
}

// Number 0: the history does not know this learner, or no more.
void LearnerMemory::follow(const LearnerRow& row) {
  if (learner_id_ != row.id) session_.reset();
  learner_id_ = row.id;
  next_ = row.next_lesson;
  if (row.id != 0) runs_ = history_->runs(row.id);
}

std::vector<CommentRow> LearnerMemory::comments(std::int64_t run) {
  std::vector<CommentRow> all;
  if (run > 0) read([&] { all = history_->comments(run); });
  const auto kept = kept_comments_.find(run);
  if (kept != kept_comments_.end()) all.insert(all.end(), kept->second.begin(), kept->second.end());
  return all;
}

void LearnerMemory::add_comment(std::int64_t run, const std::string& author, const std::string& text) {
  if (run > 0 && write([&] { history_->add_comment(run, author, text); })) return;
  kept_comments_[run].push_back({date_text(now_()), author, text});
}

void LearnerMemory::set_next_lesson(const std::string& lesson) {
  next_ = lesson;
  if (write([&] { history_->set_next_lesson(history_->learner(learner_), lesson); })) {
    kept_next_.erase(learner_);
  } else {
    kept_next_[learner_] = lesson;
  }
}

std::int64_t LearnerMemory::session(const std::string& settings) {
  if (!session_) {
    learner_id_ = history_->learner(learner_);
    session_ = history_->begin_session(*learner_id_, program_);
    settings_.reset();
  }
  if (settings_ != settings) history_->add_settings(*session_, settings);
  settings_ = settings;
  return *session_;
}

void LearnerMemory::begin_run(const LessonResult& result, const std::string& settings, const std::string& recording) {
  run_ = RunRow{0, 0, date_text(now_()), recording, result};
  complete_ = write([&] {
    run_->session = session(settings);
    run_->id = history_->begin_run(run_->session, result, recording);
  });
}

void LearnerMemory::add_shift(const ShiftRecord& shift) {
  complete_ = complete_ && write([&] { history_->add_shift(run_->id, shift); });
}

// Where the history missed a part, it gets the whole now, if it can.
std::int64_t LearnerMemory::end_run(const LessonResult& result) {
  run_->result = result;
  const bool taken = run_->id > 0 && write([&] { history_->end_run(run_->id, result); });
  const std::int64_t number = taken ? run_->id : 0;
  if (run_->id == 0) run_->id = --last_kept_;
  if (!taken) kept_[learner_].push_back(*run_);
  runs_.push_back(std::move(*run_));
  run_.reset();
  return number;
}

}  // namespace gearshift
