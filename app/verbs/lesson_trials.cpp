#include "app/verbs/lesson_trials.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/coach/coach.h"
#include "app/coach/shipped_lessons.h"
#include "app/devices/stop_signals.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/program_name.h"
#include "app/train/recording_file.h"
#include "app/training/grade.h"
#include "haptics/files/file_error.h"
#include "haptics/files/place_of.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLot = 256;  // [cycles] judged one by one; what the coach shows is made once a lot

// "  -2.0", or nothing where there is no grade to take it from.
std::string points_words(const LessonResult& result, double points) {
  return is_graded(result) ? fmt::format("-{:.1f}", points) : "";
}

void print_faults(const LessonResult& result) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < result.faults.size(); ++i) {
    const bool costs = next < result.deductions.size() && result.deductions[next].fault == i;
    const double points = costs ? result.deductions[next++].points : 0.0;
    const DriveFault& fault = result.faults[i];
    if (fault.severity == Severity::note) continue;
    print_out("  {:6.1f} s  {:<11}  {:4}  {}\n", fault.time, severity_key(fault.severity), points_words(result, points),
              fault_sentence(fault));
  }
}

void print_result(const LessonResult& result, std::int64_t run) {
  print_faults(result);
  if (run > 0) print_out("Run {}: ", run);
  const std::size_t shifts = result.shifts.size();
  print_out("{} {} in {:.1f} s. ", shifts, shifts == 1 ? "shift" : "shifts", result.duration);
  if (is_graded(result)) print_out("Grade {:.1f} of 10. ", result.grade);
  print_out("{}\n", result.passed ? "Passed." : "Not passed: " + result.why);
}

void print_shift(const ShiftRecord& shift, std::int64_t run) {
  const std::int64_t number = shift.number + 1;  // people count from 1
  if (run > 0) print_out("  run {}, shift {} written: ", run, number);
  if (run == 0) print_out("  shift {}: ", number);
  print_out("{} to {} in {:.2f} s\n", gear_name(shift.from), gear_name(shift.to), shift.end - shift.begin);
  std::fflush(stdout);
}

class Trials {
 public:
  explicit Trials(const LessonTrials& trials)
      : trials_(trials), gate_(driven_gate(trials.drive.gate)), coach_(coach_config()) {
    coach_.want_help(trials_.help);
    tell_problem();
  }

  bool to_the_end() {
    int number = 0;
    while (number < trials_.runs && !StopSignals::asked()) drive(number++);
    coach_.settle();
    if (remove_unnamed() && coach_.needs_room()) coach_.settle();  // rows before recordings
    tell_problem();
    if (number == trials_.runs && !is_cut_) return coach_.view().result.passed;
    print_problem("ended {} run {} of {}", is_cut_ ? "in" : "before", number + (is_cut_ ? 0 : 1), trials_.runs);
    return false;
  }

 private:
  CoachConfig coach_config() const {
    CoachConfig config;
    config.lessons = shipped_lessons();
    config.history = trials_.learner.empty() ? fs::path() : trials_.history.file;
    if (!trials_.learner.empty()) config.no_history = trials_.history.problem;
    config.learner = trials_.learner;
    config.program = program_name();
    config.patience = kHistoryPatience;  // nobody waits for a frame
    return config;
  }

  void drive(int number) {
    coach_.offer(trials_.drive.lesson);
    if (trials_.mode) coach_.set_mode(*trials_.mode);
    LessonDriveConfig drive = trials_.drive;
    drive.seed += static_cast<std::uint64_t>(number);
    const bool own_recording = drive.trace.empty();
    if (own_recording) {
      drive.trace = recording();
      if (!drive.trace.empty()) own_recordings_.insert(absolute_place(drive.trace).string());
    }
    coach_.begin(drive.car, gate_, trials_.settings, drive.trace.empty() ? fs::path() : absolute_place(drive.trace));
    if (trials_.help) drive.guidance = coach_.guidance();
    told_ = 0;
    told_help_ = false;
    run(drive, own_recording);
    hand_over();
    coach_.leave();  // where the learner has given up, or was asked to end
    tell_shifts();
    tell_problem();
    print_result(coach_.view().result, coach_.view().run);
  }

  // With the first cycles: what cannot begin is told alone.
  void tell_begin() {
    if (!std::exchange(told_goal_, true)) print_out("{}: {}\n", trials_.drive.lesson.title, trials_.drive.lesson.goal);
    if (!std::exchange(told_help_, true)) say_help();
  }

  void say_help() const {
    if (!trials_.help) return;
    const CoachView& view = coach_.view();
    if (view.retention) print_out("A test after a day: without help.\n");
    if (!view.retention && view.guidance == 0.0) print_out("Without help.\n");
    if (view.guidance > 0.0) print_out("With help, {:.2f}.\n", view.guidance);
  }

  // Recordings of runs that no history names; what was asked for stays. Whether there was one.
  bool remove_unnamed() {
    bool any = false;
    for (const std::string& file : coach_.forget_recordings()) {
      if (own_recordings_.contains(file)) any = remove(file) || any;
    }
    return any;
  }

  // A recording that nobody asked for must not cost the lesson: where it cannot begin, there is none. A torn one leaves
  // its room to the history.
  void run(LessonDriveConfig& drive, bool own_recording) {
    try {
      drive_lesson(drive, judge());
    } catch (const FileError& problem) {
      if (!own_recording) {
        hand_over();
        throw;
      }
      coach_.forget_recording();
      remove(drive.trace);
      hand_over();
      tell_of_recording(problem.what());
      if (coach_.view().phase != LessonPhase::driving || coach_.view().result.duration > 0.0) return;
      drive.trace.clear();
      drive_lesson(drive, judge());
    }
  }

  // In the history's folder, or nowhere.
  fs::path recording() {
    if (!coach_.view().remembers || trials_.learner.empty()) return {};
    try {
      const fs::path folder = absolute_place(trials_.history.file).parent_path() / "recordings";
      make_folder(folder);
      return free_trace(folder, drive_name(trials_.drive.lesson.key));
    } catch (const std::runtime_error& problem) {
      tell_of_recording(problem.what());
      return {};
    }
  }

  LessonJudge judge() {
    return [this](const DriveSample& sample) {
      const LessonRun& run = coach_.judge(sample);
      is_cut_ = !run.is_over() && StopSignals::asked();
      const LessonStand stand{run.view().step, run.view().guided_gear, run.is_over() || is_cut_};
      if (++unseen_ == kLot || stand.over) hand_over();
      return stand;
    };
  }

  // What was judged is seen and remembered.
  void hand_over() {
    if (unseen_ > 0) tell_begin();
    unseen_ = 0;
    coach_.add({});
    tell_shifts();
    tell_problem();
  }

  // Only now are they written.
  void tell_shifts() {
    const std::vector<ShiftRecord>& shifts = coach_.view().result.shifts;
    for (; trials_.tells_shifts && told_ < shifts.size(); ++told_) print_shift(shifts[told_], coach_.view().run);
  }

  void tell_problem() {
    const std::optional<std::string> problem = coach_.take_problem();
    if (problem && !was_told(*problem)) tell(*problem);
    has_remembered_ = has_remembered_ || coach_.view().remembers;
  }

  // Once each. Where nothing was ever remembered, what was lost is no news.
  bool was_told(const std::string& problem) const {
    return std::any_of(told_problems_.begin(), told_problems_.end(), [&](const std::string& told) {
      return problem == told || (!has_remembered_ && problem.starts_with(told));
    });
  }

  // Each trial's has another name: once is enough.
  void tell_of_recording(const std::string& problem) {
    if (!std::exchange(told_recording_, true)) tell(problem);
  }

  void tell(const std::string& problem) {
    told_problems_.push_back(problem);
    print_problem("{}", printable(problem));
  }

  static bool remove(const fs::path& file) {
    std::error_code ignored;
    return fs::remove(file, ignored);
  }

  const LessonTrials& trials_;
  const StopSignals signals_;  // before there is a history that could be left open
  Gate gate_;
  Coach coach_;
  std::size_t unseen_ = 0;  // cycles that were judged since the last lot
  std::size_t told_ = 0;    // shifts of the trial
  std::set<std::string> own_recordings_;
  std::vector<std::string> told_problems_;
  bool is_cut_ = false;  // a run was ended in its midst: it counts as left
  bool has_remembered_ = false, told_recording_ = false, told_goal_ = false, told_help_ = false;
};

}  // namespace

bool drive_trials(const LessonTrials& trials) {
  return Trials(trials).to_the_end();
}

}  // namespace gearshift
