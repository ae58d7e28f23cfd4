#include "app/coach/coach.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/coach/force_gap.h"
#include "app/coach/learner_memory.h"
#include "app/coach/planned_trial.h"
#include "app/training/grade.h"
#include "app/training/suggest.h"

namespace gearshift {
namespace {

std::vector<PastResult> past_results(const std::vector<RunRow>& runs) {
  std::vector<PastResult> past;
  for (const RunRow& run : runs) {
    if (std::optional<PastResult> result = past_result(run.result)) past.push_back(std::move(*result));
  }
  return past;
}

LessonStanding standing_in(const Lesson& lesson, const std::vector<PastResult>& past) {
  LessonStanding standing;
  standing.key = lesson.key;
  standing.title = lesson.title;
  standing.task = lesson.task;
  for (const PastResult& result : past) {
    if (result.lesson != lesson.key) continue;
    ++standing.trials;
    standing.grade = result.grade;
    standing.best = std::max(standing.best.value_or(0.0), result.grade);
    standing.passed = standing.passed || result.passed;
  }
  return standing;
}

}  // namespace

struct Coach::State {
  explicit State(const CoachConfig& a_config)
      : config(a_config), memory(config.history, config.program, config.now, config.patience) {
    if (!config.no_history.empty()) untold = config.no_history;
  }

  void look_at_learner();
  void stand();
  void suggest();
  void show_runs();
  void offer();
  void plan();
  LessonMode usual_mode() const;
  void show_mode();
  void begin(const CarSpec& car, const Gate& gate);
  bool take(std::span<const DriveSample> samples);
  void check_cycle(const DriveSample& sample);
  void check_forces(const DriveSample& sample);
  void remember();
  void leave();
  void finish();
  void check_run(std::int64_t number) const;
  void check_comment(std::int64_t number, std::int64_t comment);
  bool is_driving() const noexcept { return view.phase == LessonPhase::driving; }

  CoachConfig config;
  LearnerMemory memory;
  std::optional<std::string> untold;  // why there is no history
  CoachView view;
  std::optional<Lesson> lesson;
  std::optional<LessonMode> chosen_mode;  // by the person, for this lesson
  std::unique_ptr<LessonRun> run;         // the trial that is driven or over
  std::optional<std::uint64_t> cycle;     // of the trial's last sample
  ForceGap forces;                        // of the trial
  bool is_remembered = false;             // the trial that is shown has a run
  bool judged = false;                    // cycles that are not seen yet
  std::string settings, recording;
};

Coach::Coach(const CoachConfig& config) : state_(std::make_unique<State>(config)) {
  if (!config.learner.empty()) check_learner_name(config.learner);
  state_->memory.set_learner(config.learner);
  state_->look_at_learner();
}

Coach::~Coach() {
  state_->leave();
}

const CoachView& Coach::view() const noexcept {
  return state_->view;
}

const Lesson* Coach::lesson() const noexcept {
  return state_->lesson ? &*state_->lesson : nullptr;
}

std::optional<std::string> Coach::take_problem() {
  if (state_->untold) return std::exchange(state_->untold, std::nullopt);
  return state_->memory.take_problem();
}

void Coach::set_learner(const std::string& name) {
  if (!name.empty()) check_learner_name(name);
  if (name == state_->memory.learner() && !state_->memory.is_forgotten()) return;
  state_->leave();
  state_->memory.set_learner(name);
  state_->chosen_mode.reset();
  state_->look_at_learner();
  if (state_->lesson) state_->offer();
}

void Coach::set_mode(LessonMode mode) {
  state_->chosen_mode = mode;
  state_->show_mode();
}

void Coach::want_help(bool on) {
  state_->view.help_wanted = on;
  if (state_->view.phase == LessonPhase::offered) state_->plan();
}

void Coach::offer(const Lesson& lesson) {
  state_->leave();
  if (!state_->lesson || state_->lesson->key != lesson.key) state_->chosen_mode.reset();
  state_->lesson = lesson;  // may be the same object
  state_->memory.look_again();
  state_->look_at_learner();
  state_->offer();
}

void Coach::put_away() {
  State& state = *state_;
  state.leave();
  state.run.reset();
  state.lesson.reset();
  state.chosen_mode.reset();
  CoachView& view = state.view;
  view.phase = LessonPhase::none;
  view.lesson = view.title = view.goal = "";
  view.time_limit = 0.0;
  view.now = {};
  view.result = {};
  view.run = 0;
  state.is_remembered = false;
  view.guidance = 0.0;
  view.retention = false;
}

void Coach::begin(const CarSpec& car, const Gate& gate, const std::string& settings,
                  const std::filesystem::path& recording) {
  State& state = *state_;
  if (!state.lesson) throw std::logic_error("no lesson is offered");
  state.leave();
  state.memory.look_again();
  state.look_at_learner();
  state.begin(car, gate);
  state.settings = settings;
  state.recording = recording.string();
}

void Coach::add(std::span<const DriveSample> samples) {
  State& state = *state_;
  if (state.memory.try_again()) state.look_at_learner();
  const bool judged = std::exchange(state.judged, false);
  if (!state.is_driving() || (samples.empty() && !judged)) return;
  const bool over = state.take(samples);
  state.remember();
  if (over) state.finish();
}

const LessonRun& Coach::judge(const DriveSample& sample) {
  if (!state_->is_driving()) throw std::logic_error("no lesson is driven");
  state_->judged = true;
  (void)state_->take({&sample, 1});
  return *state_->run;
}

void Coach::leave() {
  state_->leave();
}

void Coach::forget_recording() {
  state_->recording.clear();
  if (!state_->is_remembered) return;
  state_->memory.forget_recording();
  state_->look_at_learner();
}

bool Coach::needs_room() const noexcept {
  return state_->memory.needs_room();
}

std::string Coach::settle() {
  state_->leave();
  state_->memory.settle();
  state_->look_at_learner();
  return state_->memory.problem();
}

std::vector<std::string> Coach::forget_recordings() {
  return state_->memory.forget_recordings();
}

double Coach::guidance() const noexcept {
  return state_->is_driving() ? state_->view.guidance : 0.0;
}

int Coach::guided_gear() const noexcept {
  return state_->is_driving() ? state_->view.now.guided_gear : kNeutralGear;
}

void Coach::set_next(std::string_view lesson) {
  const std::vector<Lesson>& lessons = state_->config.lessons;
  const bool known = std::any_of(lessons.begin(), lessons.end(), [&](const Lesson& l) { return l.key == lesson; });
  if (!lesson.empty() && !known) throw std::invalid_argument("\"" + std::string(lesson) + "\" is no lesson here");
  state_->memory.set_next_lesson(std::string(lesson));
  state_->look_at_learner();
}

void Coach::comment(std::int64_t run, const std::string& author, const std::string& text) {
  state_->check_run(run);
  check_typed_text(TypedText::name, "an instructor's name", author);
  check_typed_text(TypedText::comment, "a comment", text);
  state_->memory.add_comment(run, author, text);
  state_->look_at_learner();
}

void Coach::edit_comment(std::int64_t run, std::int64_t comment, const std::string& text) {
  state_->check_comment(run, comment);
  check_typed_text(TypedText::comment, "a comment", text);
  state_->memory.edit_comment(run, comment, text);
  state_->look_at_learner();
}

void Coach::delete_comment(std::int64_t run, std::int64_t comment) {
  state_->check_comment(run, comment);
  state_->memory.delete_comment(run, comment);
  state_->look_at_learner();
}

void Coach::State::check_run(std::int64_t number) const {
  const std::vector<RunRow>& runs = memory.runs();
  const bool known = std::any_of(runs.begin(), runs.end(), [&](const RunRow& row) { return row.id == number; });
  if (!known) throw std::invalid_argument("run " + std::to_string(number) + " is none of this learner's");
}

void Coach::State::check_comment(std::int64_t number, std::int64_t comment) {
  check_run(number);
  const std::vector<CommentRow> all = memory.comments(number);
  const bool known = std::any_of(all.begin(), all.end(), [&](const CommentRow& row) { return row.id == comment; });
  if (!known)
    throw std::invalid_argument("comment " + std::to_string(comment) + " is none of run " + std::to_string(number));
}

void Coach::State::look_at_learner() {
  view.learner = memory.learner();
  view.learners = memory.learners();
  stand();
  suggest();
  show_runs();
  if (is_remembered) view.run = memory.run_number();
  view.remembers = memory.works();
  view.forgotten = memory.is_forgotten();
}

void Coach::State::stand() {
  const std::vector<PastResult> past = past_results(memory.runs());
  view.lessons.clear();
  for (const Lesson& each : config.lessons) view.lessons.push_back(standing_in(each, past));
}

// The instructor's lesson goes before what the grades say, where it is one of these.
void Coach::State::suggest() {
  const std::string& wanted = memory.next_lesson();
  const auto is_wanted = [&](const Lesson& each) { return each.key == wanted; };
  view.next_by_instructor = std::any_of(config.lessons.begin(), config.lessons.end(), is_wanted);
  if (view.next_by_instructor) {
    view.next = wanted;
    view.next_why = "The instructor chose it.";
    return;
  }
  const Suggestion next = suggest_lesson(config.lessons, past_results(memory.runs())).value_or(Suggestion{});
  view.next = next.lesson;
  view.next_why = next.why;
}

void Coach::State::show_runs() {
  const std::vector<RunRow>& runs = memory.runs();
  const auto count = static_cast<std::ptrdiff_t>(std::min(runs.size(), kMostRunsShown));
  view.runs.assign(runs.rbegin(), runs.rbegin() + count);
  view.comments.clear();
  for (const RunRow& row : view.runs) view.comments.push_back(memory.comments(row.id));
}

void Coach::State::offer() {
  run.reset();
  view.phase = LessonPhase::offered;
  view.lesson = lesson->key;
  view.title = lesson->title;
  view.goal = lesson->goal;
  view.time_limit = lesson->time_limit;
  view.now = {};
  view.result = {};
  view.run = 0;
  is_remembered = false;
  show_mode();
  plan();
}

void Coach::State::plan() {
  const PlannedTrial planned = plan_trial(memory.learner(), lesson->key, memory.runs(), config.now());
  view.guidance = view.help_wanted ? planned.plan.guidance : 0.0;
  view.hints = planned.plan.hints;
  view.retention = planned.retention;
}

// Once it was passed, it is driven alone.
LessonMode Coach::State::usual_mode() const {
  const std::vector<RunRow>& runs = memory.runs();
  const bool passed = std::any_of(runs.begin(), runs.end(), [&](const RunRow& row) {
    return row.result.lesson == lesson->key && is_graded(row.result) && row.result.passed;
  });
  return passed ? LessonMode::by_yourself : LessonMode::follow_me;
}

void Coach::State::show_mode() {
  if (chosen_mode) view.mode = *chosen_mode;
  if (!chosen_mode && lesson) view.mode = usual_mode();
}

void Coach::State::begin(const CarSpec& car, const Gate& gate) {
  show_mode();
  plan();
  run = std::make_unique<LessonRun>(*lesson, car, gate, LessonRunConfig{view.mode, view.guidance, view.hints});
  cycle.reset();
  forces = {};
  view.phase = LessonPhase::driving;
  view.now = run->view();
  view.result = run->result();
  view.run = 0;
  is_remembered = false;
}

// True when the trial is over: what comes after does not belong to it.
bool Coach::State::take(std::span<const DriveSample> samples) {
  for (const DriveSample& sample : samples) {
    if (run->is_over()) break;
    check_cycle(sample);
    run->add(sample);
    check_forces(sample);
  }
  return run->is_over();
}

// One that was lost, or that is of another loop, whose cycles begin again.
void Coach::State::check_cycle(const DriveSample& sample) {
  if (cycle && sample.lever.cycle != *cycle + 1) run->mark_torn();
  cycle = sample.lever.cycle;
}

// Without them a trial says nothing of what was learnt: walls, gates and synchronisers are not felt.
void Coach::State::check_forces(const DriveSample& sample) {
  const bool was_long = forces.is_long();
  forces.add(sample, run->is_in_shift());
  if (forces.is_long() && !was_long) run->mark_forceless();
}

void Coach::State::remember() {
  if (!memory.in_run()) memory.begin_run(run->result(), settings, recording);
  is_remembered = true;
  for (const ShiftRecord& shift : run->take_shifts()) memory.add_shift(shift);
  view.now = run->view();
  view.result = run->result();
  view.run = memory.run_number();
  view.remembers = memory.works();
  if (memory.is_forgotten() && !view.forgotten) look_at_learner();
}

void Coach::State::leave() {
  if (!is_driving()) return;
  run->leave();
  finish();
}

// A trial without a sample never was.
void Coach::State::finish() {
  view.phase = LessonPhase::over;
  view.now = run->view();
  view.result = run->result();
  is_remembered = memory.in_run();
  if (is_remembered) memory.end_run(run->result());
  memory.look_again();  // the instructor may have chosen anew
  const LessonResult& result = run->result();
  const bool finished = is_graded(result) && result.end != LessonEnd::left;
  if (finished && memory.next_lesson() == result.lesson) memory.set_next_lesson("");
  look_at_learner();
  show_mode();
}

}  // namespace gearshift
