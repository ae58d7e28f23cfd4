#include "app/train/session.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/coach/shipped_lessons.h"
#include "app/limited_words.h"
#include "app/program_name.h"
#include "app/train/chosen_trainer.h"
#include "app/train/preset_shelf.h"
#include "app/train/seen_history.h"
#include "haptics/loop/preset_writer.h"
#include "haptics/rt/monotonic_clock.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

std::string first_limit(const AdmittedTuning& admitted) {
  return admitted.limited.empty() ? std::string{} : limited_words(admitted.limited.front());
}

CoachConfig coach_config(const SessionChoice& choice) {
  CoachConfig config;
  config.lessons = shipped_lessons();
  config.history = choice.history;
  config.no_history = choice.no_history;
  config.learner = learner_of(choice);
  config.program = program_name();
  return config;
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

// Of several the first.
std::string_view changed_by(const PanelRequests& requests) {
  if (requests.car) return "another car";
  if (requests.gate) return "another gate";
  if (requests.hand) return "another hand";
  return requests.preset ? "another preset" : "another setup";
}

}  // namespace

// What else ends may take its time: OpenAL without a card does after a step of the clock. No motor waits for that.
Session::~Session() {
  trainer_.reset();
}

Session::Session(const SessionChoice& choice)
    : choice_(choice),
      cabin_(cabin_seen_from(choice.camera)),
      coach_(coach_config(choice)),
      sound_(choice.sound),
      cabin_sound_(sound_, CabinSoundConfig{}) {
  controls_.ignition = true;
  if (choice.clock == TrainerClock::real_time) start_ns_ = monotonic_ns();
  offer_first(choice);
  if (choice.hand == kByItself && coach_.lesson())
    begin_lesson();
  else
    change_to(coach_.lesson() ? with_lesson(choice, *coach_.lesson()) : choice);
  if (const std::optional<std::string> problem = coach_.take_problem()) message_ = *problem;
  why_silent_ = sound_.why_silent();
  const bool missed = choice.sound == SoundOutput::card && !why_silent_.empty();
  if (missed && message_.empty()) message_ = why_silent_;
  panel_.gates = shipped_names("gates");
  panel_.presets = preset_names();
  panel_.cars = shipped_names("cars");
  panel_.cars.emplace_back(kNoCar);
  panel_.hands = {"light", "grip", "arm", std::string(kByItself)};
  if (choice.stick) panel_.hands.clear();
  panel_.device_name = choice.stick ? choice.stick->name() : std::string(kSimulatedDevice);
}

// What a person or a fault has taken, only a person gives back; a stick's forces he gives in this very frame.
bool Session::keeps_forces() {
  if (choice_.stick) return armed_now_;
  if (!trainer_) return true;
  const GuardState guard = trainer_->snapshot().guard;
  return wants_forces_ && (armed_now_ || (guard != GuardState::released && guard != GuardState::damped));
}

// All of it or nothing: what runs goes on until the new one stands. Its plate is cut for the gate, and its lever turns as
// the device's does.
void Session::change_to(const SessionChoice& choice, const Lesson* lesson, std::string_view what) {
  const ChosenCar chosen = read_chosen_car(choice);
  TrainerConfig config = chosen_trainer(choice, chosen, lesson);
  config.feet = feet(lever_ + 1);
  std::unique_ptr<Trainer> trainer;
  if (!choice.stick) trainer = std::make_unique<Trainer>(config);
  const Gate gate = trainer ? trainer->gate() : check_stick(config);
  if (lesson && choice.stick) check_gear_of(*lesson, gate);
  if (!stage_ || stage_gate_ != chosen.layout.text || !same_turn(stage_yoke_, config.preset.lever.yoke))
    show(gate, chosen.layout.text, config.preset.lever.yoke, cabin_);
  message_.clear();
  const bool armed = keeps_forces();
  close_what_ran(what);
  take_over(trainer ? std::move(trainer) : hand_over(config), lesson);
  wants_forces_ = armed;  // what a fault has taken now is not given back by the next change either
  if (armed) trainer_->arm();
  running_ = choice;
  running_.car = chosen.car;
  running_.gate = chosen.gate;
  const std::string limit = limit_words();
  if (!limit.empty()) message_ += (message_.empty() ? "" : "; ") + limit;
}

// What the device did not admit; of a stick what that is to the hand: its walls.
std::string Session::limit_words() const {
  const AdmittedTuning admitted = trainer_->admitted();
  const auto wall = std::find_if(admitted.limited.begin(), admitted.limited.end(), [](const Limited& limited) {
    return limited.what == "wall_stiffness_n_per_m" && limited.used < limited.wanted;
  });
  if (!running_.stick || admitted.limited.empty()) return first_limit(admitted);
  const std::string limit =
      wall == admitted.limited.end()
          ? first_limit(admitted)
          : fmt::format("its walls are softer, {:.0f} N/m instead of {:.0f}", wall->used, wall->wanted);
  return fmt::format("{} answers after {:.1f} ms: {}", running_.stick->name(), 1e3 * running_.stick->answer_time(),
                     limit);
}

// A lesson that is driven is left, recordings are closed, and nothing is looked at.
void Session::close_what_ran(std::string_view what) {
  const bool drives = coach_.view().phase == LessonPhase::driving;
  if (drives) coach_.leave();
  end_lesson_recording();
  if (recording()) end_recording();
  if (drives) tell_left(what);
  opening_.reset();
  player_.reset();
}

void Session::take_over(std::unique_ptr<Trainer> trainer, const Lesson* lesson) {
  feet_->give_to(++lever_);
  trainer_ = std::move(trainer);
  new_trainer_ = true;
  ++run_;
  if (trainer_->config().car) sound_car(*trainer_->config().car);
  if (trainer_->config().clock == TrainerClock::virtual_time) start_ns_ = -std::llround(1e9 * time_);
  slope_ = lesson ? lesson->start.slope : 0.0;
  held_ = false;
  if (lesson) switches_ = CarSwitches{lesson->start.running, lesson->start.hand_brake};
  if (switches_) {
    controls_.ignition = switches_->ignition;
    controls_.hand_brake = switches_->hand_brake;
  }
  trainer_->set_controls(led());
}

// Keys' feet go on from one lever to the next, which has them from take_over() on.
PersonFeet Session::feet(int lever) const {
  return [feet = feet_, lever](const DriveSample& cycle, double seconds) {
    const bool coupled = cycle.car.gear != kNeutralGear && cycle.car.clutch_capacity > 0.0;
    const Pedals pedals = feet->move(seconds, cycle.car.engine_speed, coupled, lever);
    DriverControls controls;
    controls.throttle = pedals.throttle;
    controls.brake = pedals.brake;
    controls.clutch = pedals.clutch;
    return controls;
  };
}

void Session::show(const Gate& gate, const std::string& text, const YokeGeometry& yoke, Cabin cabin) {
  StageConfig config = stage_config(gate, yoke, cabin);
  config.drive = choice_.drive;
  stage_ = std::make_unique<Stage>(config, assets_folder() / "models");
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

void Session::lead(const HandTarget& hand, const DriverControls& controls, const FootKeys& keys) {
  trainer_->set_hand(hand);
  controls_ = controls;
  feet_->ask(held_ ? FootKeys{} : keys);
}

void Session::obey(const PanelRequests& requests) {
  try {
    if (requests.stop) trainer_->stop();
    if (requests.disarm) trainer_->disarm();
    const bool arms = requests.arm && arm();
    if (requests.stop || requests.disarm || requests.arm) wants_forces_ = armed_now_ = arms;
    if (requests.tuning) message_ = first_limit(trainer_->change_tuning(*requests.tuning));
    if (requests.record) toggle_recording();
    if (requests.replay) open_last();
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
  change_to(wanted, nullptr, changed_by(requests));
  choice_ = wanted;
  if (coach_.view().learner != learner_of(choice_)) coach_.set_learner(learner_of(choice_));
}

void Session::advance(double seconds) {
  time_ += seconds;
  armed_now_ = false;
  follow_stick();
  trainer_->set_controls(led());
  if (running_.clock == TrainerClock::virtual_time) trainer_->advance(seconds);
  tell_recording_problem();
  take_events();
  take_cycles();
  look();
  end_opening();
  if (player_) show_replay(seconds);
}

void Session::take_events() {
  events_ = trainer_->take_events();
  for (HapticEvent& event : events_) event.time_ns -= start_ns_;
}

void Session::take_cycles() {
  const std::vector<DriveSample> cycles = trainer_->take_cycles();
  if (!cycles.empty()) driven_ = cycles.back().controls;
  follow_lesson(cycles);
  history_ = seen_history(cycles);
}

// After the cycles were taken: no older than the history.
void Session::look() {
  shown_ = trainer_->snapshot();
  const double apart = glm::distance(shown_.lever, shown_.proxy) + seen_offset_;
  if (seen_offset_ > 0.0 && apart > trainer_->config().preset.haptics.ghost_offset) shown_.flags |= kFlagGhost;
  newest_ns_ = shown_.time_ns;
  car_ = trainer_->config().car ? trainer_->car() : standing_car(driven_, shown_.gear);
}

void Session::place() {
  StageInput input{shown_, car_, time_};
  input.pointer = pointer_;
  if (player_ && player_->shift()) {
    const RecordedShift& shift = player_->drive().shifts()[*player_->shift()];
    input.driven_way = shift.driven;
    input.ideal_way = shift.ideal;
  }
  stage_->place(input);
  if (stage_->take_new_print()) new_model_ = true;
  const glm::vec3 knob = stage_->knob();
  if (!player_)
    for (const HapticEvent& event : events_) cabin_sound_.hear(event, knob);
  cabin_sound_.update(shown_, car_, ears_, knob, time_);
  tell_sound();
}

// Lost and found again, each once.
void Session::tell_sound() {
  if (sound_.why_silent() == why_silent_) return;
  why_silent_ = sound_.why_silent();
  message_ = why_silent_.empty() ? "the sound is back" : why_silent_;
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
  panel_.opening = opening_ ? opening_->file().filename().string() : std::string();
  panel_.gate_name = running_.gate;
  panel_.car_name = running_.car;
  panel_.preset_name = running_.preset;
  panel_.hand_name = running_.stick ? "a person's" : running_.hand.empty() ? "preset's" : running_.hand;
  if (running_.stick) panel_.stick = StickView{stick_is_there_, running_.stick->answer_time()};
  panel_.recording = trainer_->recording();
  panel_.by_itself = running_.hand == kByItself;
  panel_.lesson_catches = coach_.lesson() ? catches_sentence(*coach_.lesson()) : std::string();
  panel_.teacher_holds = held_ && !panel_.by_itself;
  panel_.trial_lost = is_lost_ && coach_.view().phase == LessonPhase::driving;
  panel_.message = message_;
  panel_.frame_ms = frame_ms_;
  return panel_;
}

}  // namespace gearshift
