// What is remembered of the learner who drives: in the history, or in memory where that cannot be used.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/history/history.h"

namespace gearshift {

// Throws nothing for the history: what goes wrong is told once, in one sentence, and tried again with the next run.
class LearnerMemory {
 public:
  LearnerMemory(const std::filesystem::path& history, std::string program, Clock now);

  bool works() const noexcept { return history_ && works_; }
  std::optional<std::string> take_problem();
  std::vector<std::string> learners();  // by name

  void set_learner(const std::string& name);  // empty: nobody. Nothing is written yet
  const std::string& learner() const noexcept { return learner_; }
  void look_again();  // reads anew where another program has written meanwhile

  // Of this learner, oldest first: those of the history, and those that it did not take, most with a negative number.
  const std::vector<RunRow>& runs() const noexcept { return runs_; }
  std::vector<CommentRow> comments(std::int64_t run);
  void add_comment(std::int64_t run, const std::string& author, const std::string& text);
  const std::string& next_lesson() const noexcept { return next_; }  // key, or empty
  void set_next_lesson(const std::string& lesson);

  // A run, from its first sample on.
  void begin_run(const LessonResult& result, const std::string& settings, const std::string& recording);
  bool in_run() const noexcept { return run_.has_value(); }
  void add_shift(const ShiftRecord& shift);
  std::int64_t run_number() const noexcept { return complete_ ? run_->id : 0; }  // 0: the history does not have it
  std::int64_t end_run(const LessonResult& result);                              // as run_number(), for the whole

 private:
  template <class Work>
  bool read(const Work& work);  // false: it failed, or there is no history
  template <class Work>
  bool write(const Work& work);
  void load();
  void follow(const LearnerRow& row);
  std::int64_t session(const std::string& settings);

  std::string program_;
  Clock now_;
  std::unique_ptr<History> history_;
  bool works_ = true;  // the last writing did
  std::string told_;   // the last problem
  std::optional<std::string> problem_;

  std::string learner_, next_;
  std::vector<RunRow> runs_;
  std::int64_t changes_ = 0;                          // of the history, when it was read
  std::optional<std::int64_t> learner_id_, session_;  // in the history
  std::optional<std::string> settings_;               // of the session

  std::optional<RunRow> run_;  // that is driven
  bool complete_ = true;       // the history has it so far

  // What the history did not take, by the learner's name and the run's number.
  std::map<std::string, std::vector<RunRow>> kept_;
  std::map<std::string, std::string> kept_next_;
  std::map<std::int64_t, std::vector<CommentRow>> kept_comments_;
  std::int64_t last_kept_ = 0;
};

}  // namespace gearshift
