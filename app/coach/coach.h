// One learner's lessons in a trainer that runs: which lesson, with how much help, what is said, what is remembered.
//
// Knows no window and no thread, and of time the samples' and the date. A history that cannot be used is told once, in
// one sentence, and the lessons go on without it; what it did not take is kept and offered again. One thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/coach/coach_view.h"
#include "app/history/date_text.h"
#include "app/training/drive_sample.h"
#include "app/training/lesson.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct CoachConfig {
  std::vector<Lesson> lessons;             // in the order of teaching: what is suggested
  std::filesystem::path history;           // empty: nothing is remembered
  std::string no_history;                  // and why not, where somebody is to be told
  std::string learner;                     // empty: nobody
  std::string program;                     // its name and version, for the history
  Clock now = system_seconds;              // [s] since 1970: when a day has passed, and the dates of what is remembered
  std::chrono::milliseconds patience{50};  // of a call, with another program that holds the history
};

class Coach {
 public:
  // Throws nothing for the history: take_problem(). std::invalid_argument for what is no name.
  explicit Coach(const CoachConfig& config);
  ~Coach();  // a lesson that is driven counts as left; settles
  Coach(const Coach&) = delete;
  Coach& operator=(const Coach&) = delete;

  const CoachView& view() const noexcept;
  const Lesson* lesson() const noexcept;      // offered, driven or over; null: none
  std::optional<std::string> take_problem();  // of the history, one sentence, once

  // Who and how; while a lesson is driven they wait for the next trial, but for the learner: that trial is left. To be
  // called where a person chooses, and only there: one whom another program deletes (CoachView::forgotten) is written
  // again from then on, the same name included.
  void set_learner(const std::string& name);  // empty: nobody. Throws std::invalid_argument for what is no name
  void set_mode(LessonMode mode);
  void want_help(bool on);

  // The lesson before this one is left. The same one again: another trial.
  void offer(const Lesson& lesson);
  void put_away();  // no lesson

  // From here on samples count; a trial without one never was. The help is what GuidancePolicy says after the learner's
  // past trials of the lesson; the first trial after a day is a retention test. settings: gate, car, preset as text;
  // recording: absolute, or empty. Throws std::invalid_argument (the gate lacks a gear), std::logic_error (nothing is
  // offered).
  void begin(const CarSpec& car, const Gate& gate, const std::string& settings, const std::filesystem::path& recording);
  // In order; a gap in the cycles tears the run. To be called in each frame, samples or none: what the history did not
  // take is offered again.
  void add(std::span<const DriveSample> samples);
  // One cycle of them, only judged: seen and remembered with the next add(), of none, too. For who drives by what the
  // judge says in each cycle. Throws std::logic_error where no lesson is driven.
  const LessonRun& judge(const DriveSample& sample);
  void leave();  // the learner gives up: phase over
  // Of the trial that is driven, or is over: it has none (any more), and no history names one.
  void forget_recording();

  // For who goes, before the last problem is told: a lesson that is driven counts as left, and what waits for the
  // history is written, with a patience of 3 s in all. Returns in one sentence what could not be kept, else a problem
  // that nobody has taken yet; empty: all is well. take_problem() has the same sentence, for who asks there. What was
  // tried in vain is not waited for again by the destructor.
  std::string settle();
  // What could not be kept lacks room on the disk: who removes files (forget_recordings()) may settle again.
  bool needs_room() const noexcept;
  // Of runs that the history has heard nothing of, or knows no more, and will not name any more: whoever wrote these
  // files removes them.
  std::vector<std::string> forget_recordings();

  // For DriverControls while it is driven; else none.
  double guidance() const noexcept;
  int guided_gear() const noexcept;

  // The instructor's. Throw std::invalid_argument for a lesson that is none of the config's, for a run that is none of
  // this learner's, a comment that is none of the run's, and what is no name or no comment (app/history/typed_text.h).
  void set_next(std::string_view lesson);  // key; empty: as suggested
  void comment(std::int64_t run, const std::string& author, const std::string& text);
  void edit_comment(std::int64_t run, std::int64_t comment, const std::string& text);  // by CommentRow::id
  void delete_comment(std::int64_t run, std::int64_t comment);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
