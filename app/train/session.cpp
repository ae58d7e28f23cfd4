#include "app/train/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/coach/shipped_lessons.h"
#include "app/learner/auto_driver.h"
#include "app/limited_words.h"
#include "app/output_folder.h"
#include "app/program_name.h"
#include "app/train/preset_shelf.h"
#include "app/train/recording_file.h"
#include "app/trainer/history.h"
#include "app/trainer/user_folder.h"
#include "app/training/lesson_world.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset_writer.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHistory = 200;  // [snapshots] a frame

std::string first_limit(const AdmittedTuning& admitted) {
  return admitted.limited.empty() ? std::string{} : limited_words(admitted.limited.front());
}

// Who learns: what a hand shows by itself is nobody's.
std::string learner_of(const SessionChoice& choice) {
  return choice.hand == kByItself ? std::string{} : choice.learner;
}

CoachConfig coach_config(const SessionChoice& choice) {
  CoachConfig config;
  config.lessons = shipped_lessons();
  config.history = choice.history;
  config.learner = learner_of(choice);
  config.program = program_name();
  return config;
}

SelfDriver self_driver(const TrainerConfig& trainer, const CarSpec& car, const Lesson* lesson) {
  const YokeGeometry& yoke = trainer.preset.lever.yoke;
  AutoDriverConfig config;
  config.gate = compile_gate(trainer.layout, workspace_half_extent(yoke), yoke.radius);
  config.car = car;
  config.lesson = lesson ? *lesson : tour_lesson(car, config.gate);
  config.again = lesson == nullptr;
  config.seed = trainer.seed;
  config.period = period_s(trainer.preset.haptics);
  const auto driver = std::make_shared<AutoDriver>(config);
  return [driver](const DriveSample& sample) { return driver->act(sample); };
}

std::vector<HapticSnapshot> levers_of(std::span<const DriveSample> cycles) {
  std::vector<HapticSnapshot> levers;
  levers.reserve(cycles.size());
  for (const DriveSample& cycle : cycles) levers.push_back(cycle.lever);
  return levers;
}

bool same_turn(const YokeGeometry& a, const YokeGeometry& b) {
  return a.radius == b.radius && a.theta_limit == b.theta_limit && a.phi_limit == b.phi_limit;
}

// Nothing behind the lever: pedals and gear, as the driver has them.
VehicleState standing_car(const DriverControls& controls, int gear) {
  VehicleState car;
  car.running = false;
  car.gear = gear;
  car.throttle = controls.throttle;
  car.brake = controls.brake;
  car.clutch = controls.clutch;
  car.hand_brake = controls.hand_brake;
  car.ignition = controls.ignition;
  return car;
}

// What the history keeps beside a lesson.
std::string settings_text(const SessionChoice& choice, const HapticTuning& tuning) {
  return fmt::format(
      "car = \"{}\"\ngate = \"{}\"\npreset = \"{}\"\nhand = \"{}\"\nwall_stiffness_n_per_m = "
      "{}\nwall_damping_n_s_per_m = {}\n",
      choice.car, choice.gate, choice.preset, choice.hand, tuning.wall_stiffness, tuning.wall_damping);
}

}  // namespace

Session::Session(const SessionChoice& choice)
    : choice_(choice),
      cabin_(cabin_seen_from(choice.camera)),
      coach_(coach_config(choice)),
      sound_(choice.sound),
      cabin_sound_(sound_, CabinSoundConfig{}) {
  controls_.ignition = true;
  if (choice.clock == TrainerClock::real_time)
    start_ns_ = std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  offer_first(choice);
  if (choice.hand == kByItself && coach_.lesson())
    begin_lesson();
  else
    change_to(coach_.lesson() ? with_lesson(choice, *coach_.lesson()) : choice);
  if (const std::optional<std::string> problem = coach_.take_problem()) message_ = *problem;
  const bool missed = choice.sound == SoundOutput::card && !sound_.why_silent().empty();
  if (missed && message_.empty()) message_ = sound_.why_silent();
  panel_.gates = shipped_names("gates");
  panel_.presets = preset_names();
  panel_.cars = shipped_names("cars");
  panel_.cars.emplace_back(kNoCar);
  panel_.hands = {"light", "grip", "arm", std::string(kByItself)};
  panel_.device_name = kSimulatedDevice;
}

TrainerConfig Session::trainer_config(const SessionChoice& choice, const ChosenCar& chosen,
                                      const Lesson* lesson) const {
  TrainerConfig config;
  config.preset = read_chosen_preset(choice);
  config.layout = chosen.layout;
  config.car = chosen.spec;
  config.clock = choice.clock;
  config.seed = choice.seed;
  config.program = program_name();
  if (lesson) {
    config.start = car_start(lesson->start);
    config.hand_brake = lesson->start.hand_brake;
  }
  if (choice.hand != kByItself) return config;
  if (!config.car) throw std::invalid_argument("a hand by itself drives a car: without one a person leads the lever");
  config.driver = self_driver(config, *config.car, lesson);
  return config;
}

// What a person or a fault has taken, only a person gives back.
bool Session::keeps_forces() {
  if (!trainer_) return true;
  const GuardState guard = trainer_->snapshot().guard;
  return wants_forces_ && (armed_now_ || (guard != GuardState::released && guard != GuardState::damped));
}

// All of it or nothing: what runs goes on until the new one stands. Its plate is cut for the gate, and its lever turns as
// the device's does.
void Session::change_to(const SessionChoice& choice, const Lesson* lesson) {
  ChosenCar chosen = read_chosen_car(choice);
  const TrainerConfig config = trainer_config(choice, chosen, lesson);
  auto trainer = std::make_unique<Trainer>(config);
  if (!stage_ || stage_gate_ != chosen.layout.text || !same_turn(stage_yoke_, config.preset.lever.yoke))
    show(trainer->gate(), chosen.layout.text, config.preset.lever.yoke, cabin_);
  message_.clear();
  const bool armed = keeps_forces();
  if (coach_.view().phase == LessonPhase::driving) coach_.leave();
  end_lesson_recording();
  if (recording()) end_recording();
  player_.reset();
  trainer_ = std::move(trainer);
  new_trainer_ = true;
  if (chosen.spec) sound_car(*chosen.spec);
  ++run_;
  slope_ = lesson ? lesson->start.slope : 0.0;
  held_ = false;
  if (lesson) switches_ = CarSwitches{lesson->start.running, lesson->start.hand_brake};
  if (switches_) {
    controls_.ignition = switches_->ignition;
    controls_.hand_brake = switches_->hand_brake;
  }
  trainer_->set_controls(led());
  wants_forces_ = armed;  // what a fault has taken now is not given back by the next change either
  if (armed) trainer_->arm();
  if (choice.clock == TrainerClock::virtual_time) start_ns_ = -std::llround(1e9 * time_);
  running_ = choice;
  running_.car = chosen.car;
  running_.gate = chosen.gate;
  const std::string limit = first_limit(trainer_->admitted());
  if (!limit.empty()) message_ += (message_.empty() ? "" : "; ") + limit;
}

void Session::show(const Gate& gate, const std::string& text, const YokeGeometry& yoke, Cabin cabin) {
  stage_ = std::make_unique<Stage>(stage_config(gate, yoke, cabin), assets_folder() / "models");
  stage_gate_ = text;
  stage_yoke_ = yoke;
  cabin_ = cabin;
  new_model_ = true;
}

void Session::sound_car(const CarSpec& car) {
  CabinSoundConfig config = cabin_sound_.config();
  config.dog_teeth = car.synchro.teeth;
  cabin_sound_.set_config(config);
}

void Session::look_from(std::string_view camera) {
  const Cabin cabin = cabin_seen_from(camera);
  if (cabin == cabin_) return;
  try {
    show(shown_gate(), stage_gate_, stage_yoke_, cabin);
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

const Gate& Session::shown_gate() const {
  return player_ ? player_->drive().gate() : trainer_->gate();
}

void Session::lead(const HandTarget& hand, const DriverControls& controls) {
  trainer_->set_hand(hand);
  controls_ = controls;
}

void Session::obey(const PanelRequests& requests) {
  try {
    if (requests.stop) trainer_->stop();
    if (requests.disarm) trainer_->disarm();
    if (requests.arm) trainer_->arm();
    if (requests.stop || requests.disarm || requests.arm) wants_forces_ = armed_now_ = requests.arm;
    if (requests.tuning) message_ = first_limit(trainer_->change_tuning(*requests.tuning));
    if (requests.record) toggle_recording();
    if (requests.replay) look_at_last();
    if (requests.save_preset) save_preset(*requests.save_preset);
    obey_viewer(requests.look);
    change_by(requests);
    obey_instructor(requests.lesson);
    if (requests.compare) {
      panel_.compared.reset();
      panel_.compared = read_preset(preset_file(*requests.compare).string());
    }
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

// What was tuned stays, unless a preset was asked for.
void Session::change_by(const PanelRequests& requests) {
  if (!requests.gate && !requests.car && !requests.preset && !requests.hand && !requests.restart) return;
  SessionChoice wanted = choice_;
  if (wanted.car.empty()) wanted.car = kUsualCar;
  wanted.haptics = trainer_->config().preset.haptics;
  if (requests.gate) wanted = with_gate(wanted, *requests.gate);
  if (requests.car) {
    wanted.car = *requests.car;
    wanted.gate = wanted.car == kNoCar ? running_.gate : std::string{};
  }
  if (requests.hand) wanted.hand = *requests.hand;
  if (requests.restart) wanted.haptics = *requests.restart;
  if (requests.preset) {
    wanted.preset = *requests.preset;
    wanted.haptics.reset();
  }
  change_to(wanted);
  choice_ = wanted;
  if (coach_.view().learner != learner_of(choice_)) coach_.set_learner(learner_of(choice_));
}

// The first that is named, else the one that is suggested; a hand that needs nobody drives what is named alone.
void Session::offer_first(const SessionChoice& choice) {
  std::string name = choice.lesson;
  const bool suggested = name.empty();
  if (suggested && choice.hand != kByItself && choice.car != kNoCar) name = coach_.view().next;
  if (name.empty() || name == kNoLesson) return;
  coach_.offer(read_lesson(find_asset("lessons", name)));
  coach_.want_help(choice.help);
  if (choice.mode) coach_.set_mode(*choice.mode);
}

void Session::obey_instructor(const LessonRequests& requests) {
  if (requests.learner) {
    choice_.learner = *requests.learner;
    coach_.set_learner(learner_of(choice_));
    if (choice_.hand == kByItself) message_ = "the hand drives by itself: nothing is remembered of it";
  }
  if (requests.next) coach_.set_next(*requests.next);
  if (requests.comment) coach_.comment(requests.comment->run, requests.comment->author, requests.comment->text);
  if (requests.offer) coach_.offer(read_lesson(find_asset("lessons", *requests.offer)));
  if (requests.mode) coach_.set_mode(*requests.mode);
  if (requests.help) coach_.want_help(*requests.help);
  if (requests.leave) coach_.leave();
  if (requests.put_away) {
    coach_.put_away();
    slope_ = 0.0;
    held_ = false;
  }
  if (requests.begin && coach_.lesson()) begin_lesson();
  if (coach_.view().phase != LessonPhase::driving) end_lesson_recording();
}

// What lay before the trial's first cycle is not the coach's.
void Session::begin_lesson() {
  const Lesson lesson = *coach_.lesson();
  if (coach_.view().phase == LessonPhase::over) coach_.offer(lesson);
  SessionChoice wanted = with_lesson(choice_, lesson);
  if (trainer_) wanted.haptics = trainer_->config().preset.haptics;
  change_to(wanted, &lesson);
  const CoachView& view = coach_.view();
  fs::path recording;
  if (view.remembers && !view.learner.empty()) recording = record_lesson(lesson);
  (void)trainer_->take_cycles();
  coach_.begin(*trainer_->config().car, trainer_->gate(),
               settings_text(running_, trainer_->config().preset.haptics.tuning), recording);
  trainer_->set_controls(led());
}

// A lesson can be driven without.
fs::path Session::record_lesson(const Lesson& lesson) {
  const std::string news = message_;
  try {
    start_recording(drive_name(lesson.key));
    records_lesson_ = true;
    message_ = news;  // nobody asked for it
    return fs::absolute(last_recording_);
  } catch (const std::exception& refused) {
    message_ = refused.what();
    return {};
  }
}

void Session::follow_lesson(std::span<const DriveSample> cycles) {
  const bool driving = coach_.view().phase == LessonPhase::driving;
  coach_.add(cycles);
  held_ = held_ || coach_.view().phase == LessonPhase::over;
  if (driving && coach_.view().phase == LessonPhase::over) end_lesson_recording();
  if (const std::optional<std::string> problem = coach_.take_problem()) message_ = *problem;
}

// The person's, on the lesson's road, with the teacher's hand; after it with the teacher's feet, to a stand.
DriverControls Session::led() const {
  DriverControls controls = controls_;
  if (held_) {
    controls.throttle = 0.0;
    controls.clutch = 1.0;
    controls.brake = std::max(controls.brake, 0.5);
  }
  controls.slope = slope_;
  controls.guidance = coach_.guidance();
  controls.guided_gear = coach_.guided_gear();
  return controls;
}

void Session::advance(double seconds) {
  time_ += seconds;
  armed_now_ = false;
  trainer_->set_controls(led());
  if (running_.clock == TrainerClock::virtual_time) trainer_->advance(seconds);
  if (const std::optional<std::string> problem = trainer_->take_recording_problem()) {
    (void)trainer_->stop_recording();
    message_ = *problem;
  }
  events_ = trainer_->take_events();
  for (HapticEvent& event : events_) event.time_ns -= start_ns_;
  const std::vector<DriveSample> cycles = trainer_->take_cycles();
  follow_lesson(cycles);
  history_ = thinned(levers_of(cycles), kMostHistory);
  shown_ = trainer_->snapshot();  // last: no older than the history
  newest_ns_ = shown_.time_ns;
  car_ = trainer_->config().car ? trainer_->car() : standing_car(controls_, shown_.gear);
  if (player_) show_replay(seconds);
}

// What is shown is of the trace then, but for the guard: its state is that of the lever that runs.
void Session::show_replay(double seconds) {
  if (player_->jumped()) ++run_;
  (void)player_->advance(seconds);
  const GuardState guard = shown_.guard;
  const GuardFault fault = shown_.fault;
  shown_ = player_->now().lever;
  shown_.guard = guard;
  shown_.fault = fault;
  car_ = player_->now().car;
  history_ = thinned(levers_of(player_->passed()), kMostHistory);
}

void Session::place() {
  StageInput input{shown_, car_, time_};
  if (player_ && player_->shift()) {
    const RecordedShift& shift = player_->drive().shifts()[*player_->shift()];
    input.driven_way = shift.driven;
    input.ideal_way = shift.ideal;
  }
  stage_->place(input);
  const glm::vec3 knob = stage_->knob();
  if (!player_)
    for (const HapticEvent& event : events_) cabin_sound_.hear(event, knob);
  cabin_sound_.update(shown_, car_, ears_, knob, time_);
}

bool Session::take_new_trainer() {
  return std::exchange(new_trainer_, false);
}

bool Session::take_new_model() {
  return std::exchange(new_model_, false);
}

std::optional<CarSwitches> Session::take_switches() {
  return std::exchange(switches_, std::nullopt);
}

void Session::toggle_recording() {
  if (coach_.view().phase == LessonPhase::driving)
    throw std::runtime_error("a lesson is recorded by itself, from its begin to its end, where a learner is named");
  if (recording())
    end_recording();
  else
    start_recording(drive_name("drive"));
}

// Beside the history that names them.
fs::path Session::recordings_folder() const {
  const fs::path data = choice_.history.empty() ? user_data_folder() : fs::absolute(choice_.history).parent_path();
  return data / "recordings";
}

void Session::start_recording(const std::string& name) {
  const fs::path folder = recordings_folder();
  make_folder(folder);
  const fs::path file = free_trace(folder, name);
  trainer_->start_recording(file);
  last_recording_ = file;
  records_lesson_ = false;
  message_ = fmt::format("recording to {}", file.string());
}

bool Session::end_recording() {
  const std::optional<std::string> problem = trainer_->stop_recording();
  message_ = problem ? *problem : fmt::format("recorded: {}", last_recording_.string());
  return !problem;
}

// It is found in the history.
void Session::end_lesson_recording() {
  if (!recording() || !records_lesson_) return;
  if (const std::optional<std::string> problem = trainer_->stop_recording()) message_ = *problem;
}

void Session::look_at_last() {
  check_free_to_look();
  if (recording() && !end_recording()) return;
  if (last_recording_.empty()) throw std::runtime_error("nothing has been recorded yet");
  look_at(last_recording_);
}

void Session::obey_viewer(const ReplayRequests& requests) {
  if (requests.open) {
    look_at(requests.open->recording);
    player_->look_near(requests.open->begin);
  }
  if (!player_) return;
  if (requests.shift) player_->look_at(requests.shift);
  if (requests.whole) player_->look_at(std::nullopt);
  if (requests.seek) player_->seek(*requests.seek);
  if (requests.pace) player_->set_pace(*requests.pace);
  if (requests.play) player_->play(*requests.play);
  if (requests.close) end_replay();
}

void Session::check_free_to_look() const {
  if (coach_.view().phase == LessonPhase::driving)
    throw std::runtime_error("a lesson is being driven: leave it before looking at a recording");
}

// In the cabin of its own gate.
void Session::look_at(const fs::path& recording, std::optional<std::size_t> shift) {
  check_free_to_look();
  Player player(recording);
  if (shift) player.look_at(shift);
  const TraceHeader& header = player.drive().header();
  const bool same_lever = header.device.yoke_radius == trainer_->device().yoke_radius &&
                          header.device.workspace == trainer_->device().workspace;
  if (!same_lever)
    throw std::runtime_error(
        fmt::format("{}: recorded with another lever: choose its preset first", recording.string()));
  if (header.gate_text != stage_gate_) show(player.drive().gate(), header.gate_text, stage_yoke_, cabin_);
  player_ = std::move(player);
  message_ = fmt::format("replaying {}", recording.string());
}

void Session::end_replay() {
  player_.reset();
  ++run_;
  message_.clear();
  const TrainerConfig& config = trainer_->config();
  if (stage_gate_ != config.layout.text) show(trainer_->gate(), config.layout.text, stage_yoke_, cabin_);
}

void Session::save_preset(const std::string& name) {
  const fs::path file = own_preset_file(name);
  Preset preset = trainer_->config().preset;
  preset.name = name;
  write_preset(preset, file);
  choice_.preset = running_.preset = name;
  panel_.presets = preset_names();
  message_ = fmt::format("saved as {}", file.string());
}

const PanelInput& Session::panel_input() {
  panel_.gate = &shown_gate();
  panel_.device = &trainer_->device();
  panel_.haptics = trainer_->config().preset.haptics;
  panel_.admitted = trainer_->admitted();
  panel_.now = shown_;
  panel_.run = run_;
  panel_.history = history_;
  panel_.events = player_ ? std::vector<HapticEvent>{} : events_;
  panel_.health = trainer_->health();
  panel_.car = car_;
  panel_.coach = coach_.view();
  panel_.replay = player_ ? &*player_ : nullptr;
  panel_.gate_name = running_.gate;
  panel_.car_name = running_.car;
  panel_.preset_name = running_.preset;
  panel_.hand_name = running_.hand.empty() ? "preset's" : running_.hand;
  panel_.recording = trainer_->recording();
  panel_.message = message_;
  panel_.frame_ms = frame_ms_;
  return panel_;
}

}  // namespace gearshift
