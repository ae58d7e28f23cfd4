// What is remembered of the learner who drives: in the history, and in memory until that has taken it.
//
// Called in the frame that also asks whether STOP was pressed: a file that another program holds is waited for as long
// as the patience is, once; from then on until it is free each try takes no time.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/history/history.h"

namespace gearshift {

// Throws nothing for the history: what goes wrong is told once, in one sentence. What it did not take is kept, in
// order, and offered again with each next writing and by try_again(). A learner is who was chosen, by the number in the
// history, not by the name: who was deleted there is told and forgotten, and never made anew by what is written here.
class LearnerMemory {
 public:
  LearnerMemory(const std::filesystem::path& history, std::string program, Clock now,
                std::chrono::milliseconds patience);
  ~LearnerMemory();  // settles, where settle() has not tried in vain
  LearnerMemory(const LearnerMemory&) = delete;
  LearnerMemory& operator=(const LearnerMemory&) = delete;

  bool works() const noexcept { return history_ && works_ && !is_forgotten(); }  // one that is held for a moment does
  std::optional<std::string> take_problem();
  std::string problem() const { return problem_.value_or(""); }  // that nobody has taken yet, or empty
  std::vector<std::string> learners();                           // by name

  // A person chooses: whoever has that name now, or somebody new. Empty: nobody. Nothing is written yet.
  void set_learner(const std::string& name);
  const std::string& learner() const noexcept { return person_->name; }
  // Deleted by another program: nothing is written until the next set_learner(), the same name included.
  bool is_forgotten() const noexcept { return person_->deleted; }
  // Reads anew where another program has written meanwhile; opens what could not be opened.
  void look_again();

  // Of this learner, oldest first: those of the history, and those that it has not taken, these with a negative number
  // until it knows of them.
  const std::vector<RunRow>& runs() const noexcept { return runs_; }
  std::vector<CommentRow> comments(std::int64_t run);  // numbers are negative until the history knows of them
  void add_comment(std::int64_t run, const std::string& author, const std::string& text);
  void edit_comment(std::int64_t run, std::int64_t comment, const std::string& text);
  void delete_comment(std::int64_t run, std::int64_t comment);
  const std::string& next_lesson() const noexcept { return next_; }  // key, or empty
  void set_next_lesson(const std::string& lesson);

  // A run, from its first sample on.
  void begin_run(const LessonResult& result, const std::string& settings, const std::string& recording);
  bool in_run() const noexcept { return in_run_; }
  void add_shift(const ShiftRecord& shift);
  void end_run(const LessonResult& result);
  void forget_recording();  // of the one that is driven, or of the last: it has none (any more)
  // Of the one that is driven, or of the last; 0: the history does not have all of it so far.
  std::int64_t run_number() const noexcept;

  // What waits, some times a second however often it is called. True: some of it was taken, or somebody forgotten.
  bool try_again();
  // The same for who goes, with a patience of 3 s in all. What still waits then is a problem to be taken.
  void settle();
  // What waits, waits for room on the disk.
  bool needs_room() const noexcept { return is_full_; }
  // Of runs that the history has heard nothing of, and will not hear of these files, or is to know no more.
  std::vector<std::string> forget_recordings();

 private:
  using Moment = std::chrono::steady_clock::time_point;

  enum class Given { taken, waits, lost };  // lost: it is never taken, the learner was deleted

  struct Person {
    std::string name;     // empty: nobody
    std::int64_t id = 0;  // in the history; 0: it knows of none
    bool deleted = false;
  };
  using PersonHere = std::shared_ptr<Person>;  // of a choice, by all that it left

  struct KeptRun {
    PersonHere of;
    std::string settings;
    std::int64_t at = 0;  // [s] since 1970
    RunRow row;
    std::size_t shifts = 0;  // that the history has
    bool over = false, written = false;
  };
  struct KeptComment {
    PersonHere of;
    std::int64_t run = 0;
    std::int64_t at = 0;  // [s] since 1970
    CommentRow row;       // number below 0: a new one; else what that one is to become
    bool taken_back = false, written = false;
  };
  struct KeptNext {
    PersonHere of;
    std::int64_t at = 0;  // [s] since 1970
    std::string lesson;
    bool written = false;
  };
  struct KeptLoss {  // of a run that the history has: its recording is gone
    PersonHere of;
    std::int64_t at = 0;  // [s] since 1970
    std::int64_t run = 0;
    bool written = false;
  };
  struct DrivingSession {
    PersonHere of;
    std::int64_t id = 0;
    std::optional<std::string> settings;  // the last that were told
  };

  static constexpr const char* kWaitsForRoom = "; what is to be remembered waits in this program until there is room";

  void open(std::chrono::milliseconds patience);
  void tell(const std::string& problem);
  std::chrono::milliseconds patience_now() const;
  template <class Work>
  bool read(const Work& work);  // false: it failed, or there is no history
  template <class Work>
  Given give(Person& of, std::int64_t at, const Work& work);
  PersonHere person_called(const std::string& name);
  void load();
  bool drop_deleted();
  bool drop_what_is_of(const PersonHere& gone);
  bool waits_for_history(const Person& of) const noexcept;
  bool is_waiting(const KeptRun& run) const noexcept;
  bool is_waiting(const KeptComment& comment) const noexcept;
  bool is_waiting(const KeptNext& next) const noexcept;
  bool is_waiting(const KeptLoss& loss) const noexcept;
  bool anything_waits() const noexcept;
  std::string what_waits() const;
  void write_now();
  bool write_kept(Moment until);
  Given write(KeptRun& run);
  Given write(KeptComment& comment);
  Given write(KeptNext& next);
  Given write(KeptLoss& loss);
  KeptComment* kept_comment(std::int64_t comment) noexcept;
  void begin(KeptRun& run);
  void renumber(KeptRun& run, std::int64_t number);
  std::int64_t session_of(const KeptRun& run);
  std::int64_t id_of(Person& person);

  static constexpr std::chrono::milliseconds kNoPatience{0};  // for who holds the file already

  std::filesystem::path file_;
  std::string program_;
  Clock now_;
  std::chrono::milliseconds patience_;
  std::optional<Moment> settles_until_;
  std::optional<std::int64_t> writing_of_;  // [s] since 1970: what is written is dated so; else now
  std::unique_ptr<History> history_;
  bool works_ = true;                           // the last writing did
  bool is_held_ = false, cannot_read_ = false;  // by another program, at the last try
  bool is_full_ = false;                        // the disk was, at the last try
  bool gave_up_ = false;                        // settling, and nothing has come since
  std::string told_, why_;                      // the last problem; the last reason why something waits
  std::string loss_;                            // what the last settling has told
  std::string promise_;                         // to wait, as it was told last
  std::optional<std::string> problem_;

  PersonHere person_ = std::make_shared<Person>();  // who was chosen last
  std::vector<PersonHere> people_;                  // who was chosen, and was not deleted since
  std::string next_;
  std::vector<RunRow> runs_;
  std::optional<std::int64_t> changes_;  // of the history, when it was read; none: it was not
  std::optional<DrivingSession> session_;

  // What the history has not taken.
  std::vector<KeptRun> kept_;  // as they were driven: the one that is, is the last
  std::vector<KeptComment> kept_comments_;
  std::vector<KeptNext> kept_next_;  // one of each person
  std::vector<KeptLoss> kept_losses_;
  std::vector<std::string> forgotten_recordings_;
  bool in_run_ = false;
  std::int64_t last_run_ = 0;   // the last one's number
  std::int64_t last_kept_ = 0;  // the last number that was given here
  Moment next_try_{};
};

}  // namespace gearshift
