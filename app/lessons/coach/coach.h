// The coach of a running session: decides which lesson runs, how much help and which prompts it gives, and what is
// saved.
//
// The coach is independent of windows and threads; it takes the time from the samples and the date from
// CoachConfig::now. A history that cannot be used is reported once, in one sentence, and lessons continue without it;
// results that could not be saved are kept in memory and retried. Use from one thread.
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
  std::string program;                         // name and version, written to the history
  Clock now = system_seconds;                  // [s] since 1970; dates saved results and decides when a day has passed
  std::chrono::milliseconds lock_timeout{50};  // how long a call waits for another program that locks the history
};

class Coach {
 public:
  // Problems of the history do not throw: see take_problem(). Throws std::invalid_argument if the learner's name is
  // invalid.
  explicit Coach(const CoachConfig& config);
  ~Coach();  // ends a running lesson early and flushes
  Coach(const Coach&) = delete;
  Coach& operator=(const Coach&) = delete;

  const CoachView& view() const noexcept;
  const Lesson* lesson() const noexcept;      // lesson that is offered, running or over; null: none
  std::optional<std::string> take_problem();  // problem of the history in one sentence, returned once

  // During a lesson a new mode applies from the next trial on; a new learner ends the trial. Call set_learner() only
  // when the user chooses a learner: if another program deleted this learner (CoachView::learner_deleted), the call
  // creates the learner again, even under the same name.
  void set_learner(const std::string& name);  // empty: no learner. Throws std::invalid_argument for an invalid name
  void set_mode(LessonMode mode);
  void set_help(bool on);

  // Ends a running lesson early. Offering the same lesson again prepares a new trial.
  void offer(const Lesson& lesson);
  void dismiss_lesson();  // back to no lesson

  // Starts a trial: samples count from now on; a trial without samples is not saved. GuidancePolicy decides the help
  // from the learner's past trials of the lesson; the first trial after a day is a retention test. settings: gate, car
  // and preset as text; recording: absolute path, or empty. Throws std::invalid_argument if the gate lacks a gear,
  // std::logic_error if no lesson is offered.
  void begin(const vehicle::CarSpec& car, const haptics::Gate& gate, const std::string& settings,
             const std::filesystem::path& recording);
  // Adds samples in order; a gap in the cycles marks the run as incomplete. Call in every frame, even without samples:
  // results that the history could not save are retried here.
  void add(std::span<const vehicle::DriveSample> samples);
  // Judges one cycle, for simulated drivers, which act on the result in every cycle. The view and the saved results are
  // updated at the next add(), which may have no samples. Throws std::logic_error if no lesson is running.
  const LessonRun& judge(const vehicle::DriveSample& sample);
  void leave();  // ends the lesson early; the phase becomes `over`
  // Removes the recording's path from the current or last trial and from the history.
  void clear_recording();

  // Call before the program ends. Ends a running lesson early and saves pending results, waiting up to 3 s in all for
  // the history. Returns one sentence: what could not be saved, else a problem that take_problem() has not returned
  // yet; empty if everything is saved. take_problem() returns the same sentence. The destructor does not wait again for
  // results that flush() could not save.
  std::string flush();
  // True if results could not be saved because the disk is full: the caller may delete files
  // (take_unreferenced_recordings()) and flush again.
  bool needs_room() const noexcept;
  // Returns recordings that the history does not and will not reference, for the caller to delete.
  std::vector<std::string> take_unreferenced_recordings();

  // Values for DriverControls while a lesson is running; otherwise 0 and kNeutralGear.
  double guidance() const noexcept;
  int guided_gear() const noexcept;

  // For the instructor. These functions throw std::invalid_argument for a lesson that is not in the config, a run of a
  // different learner, a comment of a different run, or an invalid name or comment (app/lessons/history/user_text.h).
  void set_next(std::string_view lesson);  // the lesson's key; empty: as suggested
  void add_comment(std::int64_t run, const std::string& author, const std::string& text);
  void edit_comment(std::int64_t run, std::int64_t comment, const std::string& text);  // comment: CommentRow::id
  void delete_comment(std::int64_t run, std::int64_t comment);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::lessons
