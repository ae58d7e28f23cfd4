// The coach decides which lesson runs, how much help and which prompts the learner gets, and what is saved.
//
// The coach uses no windows or threads; use it from one thread. The samples provide the time, CoachConfig::now the
// date. If the history file cannot be used, the coach reports this once and works without a history. Results that could
// not be saved stay in memory, and the coach tries again to save them.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/coach/coach_view.h"
#include "app/lessons/history/utc_time.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

struct CoachConfig {
  std::vector<Lesson> lessons;                 // in teaching order; used for suggestions
  std::filesystem::path history;               // empty: nothing is saved
  std::string no_history;                      // reason why nothing is saved, if the user should see it
  std::string learner;                         // empty: no learner
  std::string program;                         // program name and version, written to the history
  Clock now = system_seconds;                  // [s] since 1970; dates results and decides when a day has passed
  std::chrono::milliseconds lock_timeout{50};  // how long a call waits for another program that locks the history
};

class Coach {
 public:
  // Problems with the history do not throw; take_problem() returns them. Throws std::invalid_argument if the learner's
  // name is invalid.
  explicit Coach(const CoachConfig& config);
  ~Coach();  // ends a running lesson early and flushes
  Coach(const Coach&) = delete;
  Coach& operator=(const Coach&) = delete;

  const CoachView& view() const noexcept;
  const Lesson* lesson() const noexcept;      // lesson that is offered, running or over; null: none
  std::optional<std::string> take_problem();  // problem with the history in one sentence, returned once

  // A different learner ends the current trial. Call set_learner() only when the user chooses a learner: if another
  // program has deleted the current learner (CoachView::learner_deleted), the call creates a new one, even for the same
  // name. The name may be typed in another form (find_name() in user_text.h). set_mode() during a lesson applies from
  // the next trial on.
  void set_learner(const std::string& typed);  // empty: no learner. Throws std::invalid_argument for an invalid name
  // Throws std::invalid_argument for an invalid name, for another learner's name, and without a learner.
  void rename_learner(const std::string& typed);
  void set_mode(LessonMode mode);
  void set_help(bool on);
  void set_speed_unit(vehicle::SpeedUnit unit);  // of the goal that is shown before the lesson: the current car's

  // Ends a running lesson early. Offering the same lesson again prepares a new trial.
  void offer(const Lesson& lesson);
  void dismiss_lesson();  // returns to the state without a lesson

  // Starts a trial, whose first sample is the next one. A trial without samples is not saved. GuidancePolicy decides
  // how much guidance the trial gets, from the learner's past trials of this lesson. The first trial after a pause of
  // 20 h (kRetentionPause) is a retention test. `recording`: absolute path, or empty. Throws std::invalid_argument if the
  // gate lacks a gear that the lesson needs, and std::logic_error if no lesson is offered.
  void begin(const vehicle::CarSpec& car, const haptics::Gate& gate, const std::filesystem::path& recording);
  // Processes samples in order; a gap in their cycle numbers makes the run incomplete. Call in every frame, even
  // without samples, because this call also retries to save results.
  void add(std::span<const vehicle::DriveSample> samples);
  // Judges one cycle. For simulated drivers, which need the result after every cycle. The view's `now` and `result`
  // follow at once; the next add(), with or without samples, updates the phase and saves results. Throws
  // std::logic_error if no lesson is running.
  const LessonRun& assess(const vehicle::DriveSample& sample);
  void judge_by_errors();  // call if keys move the pedals, see LessonRun
  void leave();            // ends the lesson early; the phase becomes `over`
  // Removes the recording's path from the current or last trial and from the history.
  void clear_recording();

  // Call before the program ends. Ends a running lesson early and saves pending results; waits for the history for at
  // most 3 s. Returns the pending problem in one sentence: what could not be saved, or an earlier problem; empty if
  // there is none. The problem stays pending, so take_problem() returns it as well. The destructor does not wait again
  // for results that flush() could not save.
  std::string flush();
  // True if results could not be saved because the disk is full. The caller may then delete the files of
  // take_unreferenced_recordings() and call flush() again.
  bool needs_room() const noexcept;
  // Returns recordings to which no run in the history refers or will refer. The caller may delete them.
  std::vector<std::string> take_unreferenced_recordings();

  // The guidance gain and the guided gear for DriverControls. While no lesson is running: 0 and kNeutralGear.
  double guidance() const noexcept;
  double pedal_help() const noexcept;  // 0 while no lesson is running
  int guided_gear() const noexcept;

  // The condition that ends the present step, and its gear, if its prompt is shown; null and kNeutralGear otherwise.
  const DriveCondition* prompted_step() const noexcept;
  int prompted_gear() const noexcept;

  // For the instructor. These functions throw std::invalid_argument for a lesson that is not in the config, a run of a
  // different learner, a comment of a different run, or an invalid name or comment (app/lessons/history/user_text.h).
  void set_next(std::string_view lesson);  // lesson key; empty: the suggested lesson
  void add_comment(std::int64_t run, const std::string& author, const std::string& text);
  void edit_comment(std::int64_t run, std::int64_t comment, const std::string& text);  // comment: CommentRow::id
  void delete_comment(std::int64_t run, std::int64_t comment);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::lessons
