#include "app/verbs/lesson_trials.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/program_name.h"
#include "app/base/stop_signals.h"
#include "app/lessons/assessment/grade.h"
#include "app/lessons/coach/coach.h"
#include "app/lessons/coach/shipped_lessons.h"
#include "app/lessons/report/report_json.h"
#include "app/session/recording_file.h"
#include "app/verbs/history_choice.h"
#include "app/verbs/print_json.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"
#include "haptics/files/resolve_path.h"

namespace gearshift::verbs {
namespace {

namespace fs = std::filesystem;

// [cycles] The coach judges every cycle, but updates its view only at this interval.
constexpr std::size_t kBatchSize = 256;

// Formats deducted points: "-2.0"; empty if the run is not graded.
std::string format_points(const lessons::LessonResult& result, double points) {
  return lessons::is_graded(result) ? fmt::format("-{:.1f}", points) : "";
}

void print_errors(const lessons::LessonResult& result) {
  for (const lessons::DrivingError& error : result.errors) {
    if (error.severity == lessons::Severity::note) continue;
    base::print_out("  {:6.1f} s  {:<11}  {:4}  {}\n", error.time, lessons::to_string(error.severity),
                    format_points(result, error.points), lessons::error_sentence(error));
  }
}

// Prints the figures of a run that was judged by a norm, each with its norm.
void print_figures(const lessons::LessonResult& result, const lessons::Norm* norm) {
  if (norm == nullptr || !result.score) return;
  for (const lessons::FigureLine& line : lessons::figure_lines(result, norm))
    base::print_out("  {:<36}{:>10}{}\n", line.label, line.value, line.norm.empty() ? "" : "  norm " + line.norm);
  base::print_out("  {}\n", lessons::kNormOrigin);
}

void print_result(const lessons::CoachView& view) {
  const lessons::LessonResult& result = *view.result;
  const std::int64_t run = view.run;
  print_errors(result);
  print_figures(result, view.norm);
  if (run > 0) base::print_out("Run {}: ", run);
  const std::size_t shifts = result.shifts.size();
  base::print_out("{} {} in {:.1f} s. ", shifts, shifts == 1 ? "shift" : "shifts", result.duration);
  if (lessons::is_graded(result)) base::print_out("Grade {:.1f}/10. ", result.grade);
  base::print_out("{}\n", result.passed ? "Passed." : "Not passed: " + result.why);
  if (!view.mend.empty()) base::print_out("To mend: {}\n", view.mend);
  if (!view.mastery.empty()) base::print_out("{}\n", view.mastery);
}

void print_shift(const lessons::ShiftRecord& shift, std::int64_t run) {
  const std::int64_t number = shift.number + 1;  // printed numbers start at 1
  if (run > 0) base::print_out("  run {}, shift {} saved: ", run, number);
  if (run == 0) base::print_out("  shift {}: ", number);
  base::print_out("{} to {} in {:.2f} s\n", haptics::gear_name(shift.from), haptics::gear_name(shift.to),
                  shift.end - shift.begin);
  std::fflush(stdout);
}

class Trials {
 public:
  explicit Trials(const LessonTrials& trials)
      : trials_(trials), gate_(lessons::driven_gate(trials.drive.gate)), coach_(coach_config()) {
    coach_.set_help(trials_.help);
    report_coach_problem();
  }

  bool run_all() {
    int number = 0;
    while (number < trials_.runs && !base::StopSignals::requested()) drive(number++);
    coach_.flush();
    // If the disk was full, deleting unused recordings may have made room. Then try again to save the results.
    if (remove_unreferenced() && coach_.needs_room()) coach_.flush();
    report_coach_problem();
    if (trials_.json) print_document();
    if (number == trials_.runs && !is_interrupted_) return coach_.view().result->passed;
    base::print_message("interrupted {} run {} of {}", is_interrupted_ ? "during" : "before",
                        number + (is_interrupted_ ? 0 : 1), trials_.runs);
    return false;
  }

 private:
  lessons::CoachConfig coach_config() const {
    lessons::CoachConfig config;
    config.lessons = lessons::shipped_lessons();
    config.history = trials_.learner.empty() ? fs::path() : trials_.history.file;
    if (!trials_.learner.empty()) config.no_history = trials_.history.problem;
    config.learner = trials_.learner;
    config.program = base::program_name();
    config.lock_timeout = lessons::kHistoryLockTimeout;  // may be long, because no frames are drawn
    return config;
  }

  void drive(int number) {
    coach_.offer(trials_.drive.lesson);
    if (trials_.mode) coach_.set_mode(*trials_.mode);
    lessons::LessonDriveConfig drive = trials_.drive;
    drive.seed += static_cast<std::uint64_t>(number);
    const bool is_automatic_recording = drive.trace.empty();
    if (is_automatic_recording) {
      drive.trace = automatic_recording_path();
      if (!drive.trace.empty()) automatic_recordings_.insert(haptics::make_absolute(drive.trace).string());
    }
    coach_.begin(drive.car, gate_, drive.trace.empty() ? fs::path() : haptics::make_absolute(drive.trace));
    if (trials_.help) drive.guidance = coach_.guidance();
    printed_shifts_ = 0;
    has_printed_guidance_ = false;
    run(drive, is_automatic_recording);
    flush_cycles();
    coach_.leave();  // no effect unless the learner gave up or the run was interrupted
    print_new_shifts();
    report_coach_problem();
    trials_.json ? add_run(drive) : print_result(coach_.view());
  }

  void add_run(const lessons::LessonDriveConfig& drive) {
    const lessons::CoachView& view = coach_.view();
    nlohmann::ordered_json run{{"seed", drive.seed}, {"retention_test", view.retention}};
    if (view.run > 0) run["run"] = view.run;
    if (!drive.trace.empty()) run["recording"] = drive.trace.string();
    if (!view.mend.empty()) run["mend"] = view.mend;
    if (!view.mastery.empty()) run["mastery"] = view.mastery;
    run.update(lessons::result_json(*view.result, view.norm));
    runs_.push_back(std::move(run));
  }

  void print_document() const {
    nlohmann::ordered_json document{{"lesson", trials_.drive.lesson.key},
                                    {"title", trials_.drive.lesson.title},
                                    {"car", trials_.drive.car.name},
                                    {"gate", trials_.drive.gate.name}};
    if (!trials_.learner.empty()) document["learner"] = coach_.view().learner;
    document["runs"] = runs_;
    print_json(document);
  }

  // Prints the lesson's goal and guidance. Called only after the first cycle, so that a lesson that cannot start prints
  // only an error message.
  void print_start() {
    if (trials_.json) return;
    if (!std::exchange(has_printed_goal_, true))
      base::print_out("{}: {}\n", trials_.drive.lesson.title,
                      lessons::text_in_unit(trials_.drive.lesson.goal, trials_.drive.car.speed_unit));
    if (!std::exchange(has_printed_guidance_, true)) print_guidance();
  }

  void print_guidance() const {
    if (!trials_.help) return;
    const lessons::CoachView& view = coach_.view();
    if (view.retention)
      base::print_out("This run tests what you remember after a break of a day or more: no guidance.\n");
    if (!view.retention && view.guidance == 0.0 && view.pedal_help == 0.0) base::print_out("No guidance.\n");
    if (view.guidance > 0.0) base::print_out("Guidance of the lever {:.0f} %.\n", 100.0 * view.guidance);
    if (view.pedal_help > 0.0) base::print_out("Help with the pedals {:.0f} %.\n", 100.0 * view.pedal_help);
  }

  // Deletes automatic recordings to which no saved run refers. Keeps files named with --trace. Returns true if it
  // deleted a file.
  bool remove_unreferenced() {
    bool any = false;
    for (const std::string& file : coach_.take_unreferenced_recordings()) {
      if (automatic_recordings_.contains(file)) any = remove(file) || any;
    }
    return any;
  }

  // Runs the lesson. If an automatic recording fails before the first cycle, runs the lesson without a recording. If it
  // fails later, the results are kept. Either way, the failed recording is deleted.
  void run(lessons::LessonDriveConfig& drive, bool is_automatic_recording) {
    try {
      lessons::drive_lesson(drive, judge());
    } catch (const haptics::FileError& problem) {
      if (!is_automatic_recording) {
        flush_cycles();
        throw;
      }
      coach_.clear_recording();
      remove(drive.trace);
      flush_cycles();
      report_recording_problem(problem.what());
      if (coach_.view().phase != lessons::LessonPhase::driving || coach_.view().result->duration > 0.0) return;
      drive.trace.clear();
      lessons::drive_lesson(drive, judge());
    }
  }

  // Path of a new recording next to the history; empty if nothing is to be recorded.
  fs::path automatic_recording_path() {
    if (!coach_.view().is_saving || trials_.learner.empty()) return {};
    try {
      const fs::path folder = haptics::make_absolute(trials_.history.file).parent_path() / "recordings";
      base::make_folder(folder);
      return session::unused_trace_path(folder, session::recording_name(trials_.drive.lesson.key));
    } catch (const std::runtime_error& problem) {
      report_recording_problem(problem.what());
      return {};
    }
  }

  lessons::LessonJudge judge() {
    return [this](const vehicle::DriveSample& sample) {
      const lessons::LessonRun& run = coach_.assess(sample);
      is_interrupted_ = !run.is_over() && base::StopSignals::requested();
      const lessons::LessonProgress stand{run.view().step, run.view().guided_gear, run.is_over() || is_interrupted_};
      if (++pending_cycles_ == kBatchSize || stand.is_over) flush_cycles();
      return stand;
    };
  }

  // Lets the coach update its view and save results, then prints new shifts and problems.
  void flush_cycles() {
    if (pending_cycles_ > 0) print_start();
    pending_cycles_ = 0;
    coach_.add({});
    print_new_shifts();
    report_coach_problem();
  }

  // Call this after the coach has saved the shifts.
  void print_new_shifts() {
    const std::vector<lessons::ShiftRecord>& shifts = coach_.view().result->shifts;
    for (; trials_.prints_shifts && printed_shifts_ < shifts.size(); ++printed_shifts_)
      print_shift(shifts[printed_shifts_], coach_.view().run);
  }

  void report_coach_problem() {
    const std::optional<std::string> problem = coach_.take_problem();
    if (problem && !is_already_reported(*problem)) report_problem(*problem);
    has_saved_ = has_saved_ || coach_.view().is_saving;
  }

  // True if the problem was already reported. Until something has been saved, also true if the problem begins with the
  // text of a reported problem.
  bool is_already_reported(const std::string& problem) const {
    return std::any_of(reported_problems_.begin(), reported_problems_.end(), [&](const std::string& reported) {
      return problem == reported || (!has_saved_ && problem.starts_with(reported));
    });
  }

  // Reports only the first problem with a recording. Each such message names a different file, so is_already_reported()
  // would not recognise a repetition.
  void report_recording_problem(const std::string& problem) {
    if (!std::exchange(has_reported_recording_, true)) report_problem(problem);
  }

  void report_problem(const std::string& problem) {
    reported_problems_.push_back(problem);
    base::print_message("{}", haptics::printable(problem));
  }

  static bool remove(const fs::path& file) {
    std::error_code ignored;
    return fs::remove(file, ignored);
  }

  const LessonTrials& trials_;
  const base::StopSignals signals_;  // constructed before coach_, so that a signal cannot leave the history open
  haptics::Gate gate_;
  lessons::Coach coach_;
  std::size_t pending_cycles_ = 0;  // number of cycles judged since the last flush
  std::size_t printed_shifts_ = 0;  // number of printed shifts of the current run
  std::set<std::string> automatic_recordings_;
  std::vector<std::string> reported_problems_;
  nlohmann::ordered_json runs_ = nlohmann::ordered_json::array();
  bool is_interrupted_ = false;  // a signal stopped the current run; the run counts as abandoned
  bool has_saved_ = false, has_reported_recording_ = false, has_printed_goal_ = false, has_printed_guidance_ = false;
};

}  // namespace

bool drive_trials(const LessonTrials& trials) {
  std::optional<lessons::ServerLink> server;
  if (!trials.server.empty() && !trials.history.file.empty()) server.emplace(trials.history.file, trials.server);
  const bool is_passed = Trials(trials).run_all();
  if (server) finish_exchange(*server);
  return is_passed;
}

}  // namespace gearshift::verbs
