// What is remembered of the learner who drives: in the history, and in memory until that has taken it.
//
// Called in the frame that also asks whether STOP was pressed: a file that another program holds is waited for as long
// as the patience is, once; from then on until it is free each try takes no time.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/history/history.h"

namespace gearshift {

// Throws nothing for the history: what goes wrong is told once, in one sentence. What it did not take is kept, in
// order, and offered again with each next writing and by try_again().
class LearnerMemory {
 public:
  LearnerMemory(const std::filesystem::path& history, std::string program, Clock now,
                std::chrono::milliseconds patience);
  ~LearnerMemory();  // settles
  LearnerMemory(const LearnerMemory&) = delete;
  LearnerMemory& operator=(const LearnerMemory&) = delete;

  bool works() const noexcept { return history_ && works_; }  // one that is held for a moment does
  std::optional<std::string> take_problem();
  std::vector<std::string> learners();  // by name

  void set_learner(const std::string& name);  // empty: nobody. Nothing is written yet
  const std::string& learner() const noexcept { return learner_; }
  // Reads anew where another program has written meanwhile; opens what could not be opened.
  void look_again();

  // Of this learner, oldest first: those of the history, and those that it has not taken, these with a negative number
  // until it knows of them.
  const std::vector<RunRow>& runs() const noexcept { return runs_; }
  std::vector<CommentRow> comments(std::int64_t run);
  void add_comment(std::int64_t run, const std::string& author, const std::string& text);
  const std::string& next_lesson() const noexcept { return next_; }  // key, or empty
  void set_next_lesson(const std::string& lesson);

  // A run, from its first sample on.
  void begin_run(const LessonResult& result, const std::string& settings, const std::string& recording);
  bool in_run() const noexcept { return in_run_; }
  void add_shift(const ShiftRecord& shift);
  void end_run(const LessonResult& result);
  // Of the one that is driven, or of the last; 0: the history does not have all of it so far.
  std::int64_t run_number() const noexcept;

  // What waits, some times a second however often it is called. True: some of it was taken.
  bool try_again();
  void settle();  // the same, with patience: for who goes
  // Of runs that the history has heard nothing of, and will not hear of these files.
  std::vector<std::string> forget_recordings();

 private:
  using Moment = std::chrono::steady_clock::time_point;

  enum class Given { taken, waits, lost };  // lost: it is never taken, the learner was erased

  struct KeptRun {
    std::string learner, settings;
    std::int64_t at = 0;  // [s] since 1970
    RunRow row;
    std::size_t shifts = 0;  // that the history has
    bool over = false;
    bool lost = false, written = false;
  };
  struct KeptComment {
    std::int64_t run = 0;
    std::int64_t at = 0;  // [s] since 1970
    CommentRow row;
    bool lost = false, written = false;
  };
  struct KeptNext {
    std::int64_t at = 0;  // [s] since 1970
    std::string lesson;
  };
  struct DrivingSession {
    std::string learner;
    std::int64_t learner_id = 0, id = 0;
    std::optional<std::string> settings;  // the last that were told
  };

  void open(std::chrono::milliseconds patience);
  void tell(const std::string& problem);
  template <class Work>
  bool read(const Work& work);  // false: it failed, or there is no history
  template <class Work>
  Given give(std::int64_t at, const Work& work);
  void load();
  static bool is_waiting(const KeptRun& run) noexcept;
  static bool is_waiting(const KeptComment& comment) noexcept;
  bool anything_waits() const noexcept;
  bool write_kept(Moment until);
  Given write(KeptRun& run);
  Given write(KeptComment& comment);
  Given write_next(const std::string& learner, const KeptNext& next);
  void begin(KeptRun& run);
  std::int64_t session_of(const KeptRun& run);

  std::filesystem::path file_;
  std::string program_;
  Clock now_;
  std::chrono::milliseconds patience_;
  std::optional<std::int64_t> writing_of_;  // [s] since 1970: what is written is dated so; else now
  std::unique_ptr<History> history_;
  bool works_ = true;                           // the last writing did
  bool is_held_ = false, cannot_read_ = false;  // by another program, at the last try
  std::string told_;                            // the last problem
  std::optional<std::string> problem_;

  std::string learner_, next_;
  std::vector<RunRow> runs_;
  std::optional<std::int64_t> changes_;  // of the history, when it was read; none: it was not
  std::optional<DrivingSession> session_;

  // What the history has not taken.
  std::vector<KeptRun> kept_;  // as they were driven: the one that is, is the last
  std::vector<KeptComment> kept_comments_;
  std::map<std::string, KeptNext> kept_next_;  // by the learner's name
  bool in_run_ = false;
  std::int64_t last_run_ = 0;   // the last one's number
  std::int64_t last_kept_ = 0;  // the last number that was given here
  Moment next_try_{};
};

}  // namespace gearshift
