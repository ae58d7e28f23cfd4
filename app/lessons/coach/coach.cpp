#include "app/lessons/coach/coach.h"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "app/lessons/assessment/grade.h"
#include "app/lessons/assessment/suggest.h"
#include "app/lessons/coach/force_gap.h"
#include "app/lessons/coach/learner_memory.h"
#include "app/lessons/coach/planned_trial.h"
#include "app/lessons/history/graded_trials.h"
#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

LessonStanding standing_in(const Lesson& lesson, const std::vector<GradedTrial>& past, std::span<const RunRow> runs) {
  LessonStanding standing;
  standing.key = lesson.key;
  standing.title = lesson.title;
  standing.task = lesson.task;
  for (const GradedTrial& result : past) {
    if (result.lesson != lesson.key) continue;
    ++standing.trials;
    standing.grade = result.grade;
    standing.best = std::max(standing.best.value_or(0.0), result.grade);
    standing.passed = standing.passed || result.passed;
  }
  standing.mastery = mastery_of(past, lesson.key);
  standing.tries = static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [&](const RunRow& run) { return run.result.lesson == lesson.key; }));
  return standing;
}

}  // namespace

struct Coach::State {
  explicit State(const CoachConfig& a_config)
      : config(a_config), memory(config.history, config.program, config.now, config.lock_timeout) {
    if (!config.no_history.empty()) startup_problem = config.no_history;
    show_trial();
  }

  std::string name_of(const std::string& typed);
  void refresh_view();
  void update_standings();
  void suggest();
  void show_runs();
  void offer();
  void show_trial();
  void plan();
  LessonMode usual_mode() const;
  void show_mode();
  void begin(const vehicle::CarSpec& car, const haptics::Gate& gate);
  bool process_samples(std::span<const vehicle::DriveSample> samples);
  void check_cycle(const vehicle::DriveSample& sample);
  void check_forces(const vehicle::DriveSample& sample);
  void record_progress();
  void leave();
  void finish_trial();
  void check_run(std::int64_t number) const;
  void check_comment(std::int64_t number, std::int64_t comment);
  bool is_driving() const noexcept { return view.phase == LessonPhase::driving; }

  CoachConfig config;
  LearnerMemory memory;
  std::optional<std::string> startup_problem;  // why there is no history; reported to the user once
  CoachView view;
  std::vector<GradedTrial> past;  // the learner's graded trials, oldest first; as of the last refresh_view()
  std::optional<Lesson> lesson;
  vehicle::SpeedUnit unit = vehicle::SpeedUnit::km_per_h;
  std::optional<LessonMode> chosen_mode;  // mode that the user chose for this lesson
  std::unique_ptr<LessonRun> run;         // the current or last trial
  std::optional<std::uint64_t> cycle;     // number of the trial's last cycle in the haptic loop
  ForceGap forces;                        // time without forces in the trial
  bool has_saved_run = false;             // the displayed trial has a saved or pending run
  bool is_unsaved = false;                // cycles were judged since the last call of record_progress()
  std::string recording;
};

Coach::Coach(const CoachConfig& config) : state_(std::make_unique<State>(config)) {
  state_->memory.set_learner(state_->name_of(config.learner));
  state_->refresh_view();
}

Coach::~Coach() {
  try {
    state_->leave();
  } catch (const std::exception&) {
    // Only a lack of memory arrives here. A destructor must not throw.
  }
}

const CoachView& Coach::view() const noexcept {
  return state_->view;
}

const Lesson* Coach::lesson() const noexcept {
  return state_->lesson ? &*state_->lesson : nullptr;
}

std::optional<std::string> Coach::take_problem() {
  if (state_->startup_problem) return std::exchange(state_->startup_problem, std::nullopt);
  return state_->memory.take_problem();
}

// The name of the learner whom the user means, or of a new learner.
std::string Coach::State::name_of(const std::string& typed) {
  if (typed.empty()) return {};
  const std::optional<std::string> known = memory.known_name(typed);
  if (known && *known == stored_name(typed)) return *known;
  const std::string name = checked_learner_name(typed);
  return known.value_or(name);
}

void Coach::set_learner(const std::string& typed) {
  const std::string name = state_->name_of(typed);
  if (name == state_->memory.learner() && !state_->memory.is_learner_deleted()) return;
  state_->leave();
  state_->memory.set_learner(name);
  state_->chosen_mode.reset();
  state_->refresh_view();
  if (state_->lesson) state_->offer();
}

void Coach::rename_learner(const std::string& typed) {
  const std::string name = checked_learner_name(typed), now = state_->memory.learner();
  if (now.empty() || state_->memory.is_learner_deleted()) throw std::invalid_argument("no learner is chosen");
  const std::optional<std::string> known = state_->memory.known_name(name);
  if (known && *known != now)
    throw std::invalid_argument(haptics::printable(*known) +
                                " is another learner; add something that tells them apart");
  if (name == now) return;
  state_->memory.rename_learner(name);
  state_->refresh_view();
}

void Coach::set_mode(LessonMode mode) {
  state_->chosen_mode = mode;
  state_->show_mode();
}

void Coach::set_help(bool on) {
  state_->view.help_wanted = on;
  if (state_->view.phase == LessonPhase::offered) state_->plan();
}

void Coach::set_speed_unit(vehicle::SpeedUnit unit) {
  state_->unit = unit;
  if (state_->lesson) state_->view.goal = text_in_unit(state_->lesson->goal, unit);
}

void Coach::offer(const Lesson& lesson) {
  state_->leave();
  if (!state_->lesson || state_->lesson->key != lesson.key) state_->chosen_mode.reset();
  state_->lesson = lesson;
  state_->memory.reload();
  state_->refresh_view();
  state_->offer();
}

void Coach::dismiss_lesson() {
  State& state = *state_;
  state.leave();
  state.run.reset();
  state.lesson.reset();
  state.chosen_mode.reset();
  CoachView& view = state.view;
  view.phase = LessonPhase::none;
  view.lesson = view.title = view.goal = view.fail_conditions = "";
  view.time_limit = 0.0;
  state.show_trial();
  view.guidance = view.pedal_help = 0.0;
  view.retention = false;
}

void Coach::begin(const vehicle::CarSpec& car, const haptics::Gate& gate, const std::filesystem::path& recording) {
  State& state = *state_;
  if (!state.lesson) throw std::logic_error("no lesson is offered");
  state.leave();
  state.memory.reload();
  state.refresh_view();
  state.begin(car, gate);
  state.recording = recording.string();
}

void Coach::add(std::span<const vehicle::DriveSample> samples) {
  State& state = *state_;
  if (state.memory.retry_pending()) state.refresh_view();
  const bool is_unsaved = std::exchange(state.is_unsaved, false);
  if (!state.is_driving() || (samples.empty() && !is_unsaved)) return;
  const bool over = state.process_samples(samples);
  state.record_progress();
  if (over) state.finish_trial();
}

const LessonRun& Coach::assess(const vehicle::DriveSample& sample) {
  if (!state_->is_driving()) throw std::logic_error("no lesson is in progress");
  state_->is_unsaved = true;
  (void)state_->process_samples({&sample, 1});
  return *state_->run;
}

void Coach::judge_by_errors() {
  if (!state_->run) return;
  state_->run->judge_by_errors();
  state_->view.norm = state_->run->norm();
}

void Coach::leave() {
  state_->leave();
}

void Coach::clear_recording() {
  state_->recording.clear();
  if (!state_->has_saved_run) return;
  state_->memory.clear_recording();
  state_->refresh_view();
}

bool Coach::needs_room() const noexcept {
  return state_->memory.needs_room();
}

std::string Coach::flush() {
  state_->leave();
  state_->memory.flush();
  state_->refresh_view();
  return state_->memory.problem();
}

std::vector<std::string> Coach::take_unreferenced_recordings() {
  return state_->memory.take_unreferenced_recordings();
}

double Coach::guidance() const noexcept {
  return state_->is_driving() ? state_->view.guidance : 0.0;
}

double Coach::pedal_help() const noexcept {
  return state_->is_driving() ? state_->view.pedal_help : 0.0;
}

const DriveCondition* Coach::prompted_step() const noexcept {
  const State& state = *state_;
  if (!state.is_driving() || state.view.now->step >= state.lesson->steps.size()) return nullptr;
  const LessonStep& step = state.lesson->steps[state.view.now->step];
  return state.view.mode == LessonMode::follow_me || step.call ? &step.until : nullptr;
}

int Coach::prompted_gear() const noexcept {
  const DriveCondition* step = prompted_step();
  return step == nullptr ? haptics::kNeutralGear : step->gear.value_or(haptics::kNeutralGear);
}

int Coach::guided_gear() const noexcept {
  return state_->is_driving() ? state_->view.now->guided_gear : haptics::kNeutralGear;
}

void Coach::set_next(std::string_view lesson) {
  const std::vector<Lesson>& lessons = state_->config.lessons;
  const bool known = std::any_of(lessons.begin(), lessons.end(), [&](const Lesson& l) { return l.key == lesson; });
  if (!lesson.empty() && !known) throw std::invalid_argument("\"" + std::string(lesson) + "\" is not a known lesson");
  state_->memory.set_next_lesson(std::string(lesson));
  state_->refresh_view();
}

void Coach::add_comment(std::int64_t run, const std::string& author, const std::string& text) {
  state_->check_run(run);
  state_->memory.add_comment(run, checked_text(UserText::name, "an instructor's name", author),
                             checked_text(UserText::comment, "a comment", text));
  state_->refresh_view();
}

void Coach::edit_comment(std::int64_t run, std::int64_t comment, const std::string& text) {
  state_->check_comment(run, comment);
  state_->memory.edit_comment(run, comment, checked_text(UserText::comment, "a comment", text));
  state_->refresh_view();
}

void Coach::delete_comment(std::int64_t run, std::int64_t comment) {
  state_->check_comment(run, comment);
  state_->memory.delete_comment(run, comment);
  state_->refresh_view();
}

void Coach::State::check_run(std::int64_t number) const {
  const std::vector<RunRow>& runs = memory.runs();
  const bool known = std::any_of(runs.begin(), runs.end(), [&](const RunRow& row) { return row.id == number; });
  if (!known) throw std::invalid_argument("run " + std::to_string(number) + " does not belong to this learner");
}

void Coach::State::check_comment(std::int64_t number, std::int64_t comment) {
  check_run(number);
  const std::vector<CommentRow> all = memory.comments(number);
  const bool known = std::any_of(all.begin(), all.end(), [&](const CommentRow& row) { return row.id == comment; });
  if (!known)
    throw std::invalid_argument("comment " + std::to_string(comment) + " does not belong to run " +
                                std::to_string(number));
}

void Coach::State::refresh_view() {
  view.learner = memory.learner();
  view.learners = memory.learners();
  past = graded_trials(memory.runs());
  update_standings();
  suggest();
  show_runs();
  if (has_saved_run) view.run = memory.run_number();
  view.is_saving = memory.is_usable();
  view.learner_deleted = memory.is_learner_deleted();
}

void Coach::State::update_standings() {
  view.lessons.clear();
  for (const Lesson& each : config.lessons) view.lessons.push_back(standing_in(each, past, memory.runs()));
}

// Prefers the lesson that the instructor chose, if `config` contains that lesson.
void Coach::State::suggest() {
  const std::string& wanted = memory.next_lesson();
  const auto is_wanted = [&](const Lesson& each) { return each.key == wanted; };
  view.next_by_instructor = std::any_of(config.lessons.begin(), config.lessons.end(), is_wanted);
  if (view.next_by_instructor) {
    view.next = wanted;
    view.next_why = "Chosen by the instructor.";
    return;
  }
  const Suggestion next =
      suggest_lesson(config.lessons, past, ungraded_trials(memory.runs()), config.now()).value_or(Suggestion{});
  view.next = next.lesson;
  view.next_why = next.why;
}

void Coach::State::show_runs() {
  const std::vector<RunRow>& runs = memory.runs();
  const auto count = static_cast<std::ptrdiff_t>(std::min(runs.size(), kMaxRunsShown));
  view.runs.assign(runs.rbegin(), runs.rbegin() + count);
  for (RunRow& row : view.runs) row.comments = memory.comments(row.id);
}

void Coach::State::offer() {
  run.reset();
  view.phase = LessonPhase::offered;
  view.lesson = lesson->key;
  view.title = lesson->title;
  view.goal = text_in_unit(lesson->goal, unit);
  view.fail_conditions = failing_errors_sentence(*lesson);
  view.time_limit = lesson->time_limit;
  show_trial();
  show_mode();
  plan();
}

// Shows the trial `run`, which is not saved yet; none if `run` is null.
void Coach::State::show_trial() {
  static const LessonView no_prompts;
  static const LessonResult no_result;
  view.now = run ? &run->view() : &no_prompts;
  view.result = run ? &run->result() : &no_result;
  view.norm = run ? run->norm() : nullptr;
  view.mastery = view.mend = {};
  view.run = 0;
  has_saved_run = false;
}

void Coach::State::plan() {
  const PlannedTrial planned = plan_trial(memory.learner(), *lesson, memory.runs(), config.now());
  view.guidance = view.help_wanted ? planned.plan.guidance : 0.0;
  view.pedal_help = view.help_wanted ? planned.plan.pedal_help : 0.0;
  view.hints = planned.plan.hints;
  view.retention = planned.retention;
}

// Every step is prompted until the learner has passed the lesson once.
LessonMode Coach::State::usual_mode() const {
  return mastery_of(past, lesson->key) != Mastery::not_passed ? LessonMode::by_yourself : LessonMode::follow_me;
}

void Coach::State::show_mode() {
  if (chosen_mode) view.mode = *chosen_mode;
  if (!chosen_mode && lesson) view.mode = usual_mode();
}

void Coach::State::begin(const vehicle::CarSpec& car, const haptics::Gate& gate) {
  show_mode();
  plan();
  run = std::make_unique<LessonRun>(*lesson, car, gate,
                                    LessonRunConfig{view.mode, view.guidance, view.hints, view.pedal_help});
  cycle.reset();
  forces = {};
  view.phase = LessonPhase::driving;
  show_trial();
}

// Judges the samples up to the end of the trial and ignores later ones. Returns true if the trial is over.
bool Coach::State::process_samples(std::span<const vehicle::DriveSample> samples) {
  for (const vehicle::DriveSample& sample : samples) {
    if (run->is_over()) break;
    check_cycle(sample);
    run->add(sample);
    check_forces(sample);
  }
  return run->is_over();
}

// Marks the run incomplete if cycles were lost, or if the loop was restarted, which restarts the cycle numbers.
void Coach::State::check_cycle(const vehicle::DriveSample& sample) {
  if (cycle && sample.lever.cycle != *cycle + 1) run->mark_incomplete();
  cycle = sample.lever.cycle;
}

// Marks the trial if the lever had no forces for too long. Such a trial is not graded, because the learner felt neither
// walls nor synchronisers.
void Coach::State::check_forces(const vehicle::DriveSample& sample) {
  const bool was_long = forces.is_long();
  forces.add(sample, run->is_in_shift());
  if (forces.is_long() && !was_long) run->mark_forceless();
}

void Coach::State::record_progress() {
  if (!memory.in_run()) memory.begin_run(run->result(), recording);
  has_saved_run = true;
  for (const ShiftRecord& shift : run->drain_shifts()) memory.add_shift(shift);
  view.run = memory.run_number();
  view.is_saving = memory.is_usable();
  if (memory.is_learner_deleted() && !view.learner_deleted) refresh_view();
}

void Coach::State::leave() {
  if (!is_driving()) return;
  run->leave();
  finish_trial();
}

// A trial without samples is not saved.
void Coach::State::finish_trial() {
  view.phase = LessonPhase::over;
  has_saved_run = memory.in_run();
  if (has_saved_run) memory.end_run(run->result());
  memory.reload();  // the instructor may have chosen a different lesson
  const LessonResult& result = run->result();
  const bool finished = is_graded(result);
  if (finished && result.passed && memory.next_lesson() == result.lesson) memory.set_next_lesson("");
  refresh_view();
  show_mode();
  view.mend = thing_to_mend(*lesson, result, run->norm());
  const Mastery mastery = mastery_of(past, result.lesson);
  if (result.passed || (finished && mastery == Mastery::mastered)) view.mastery = mastery_sentence(mastery);
}

}  // namespace gearshift::lessons
