#include "app/session/session.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/program_name.h"
#include "app/lessons/coach/shipped_lessons.h"
#include "app/session/make_runtime_config.h"
#include "app/session/plot_samples.h"
#include "app/session/preset_store.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/preset.h"
#include "haptics/rt/monotonic_clock.h"

namespace gearshift::session {
namespace {

namespace fs = std::filesystem;

std::string first_limit(const haptics::AdmittedTuning& admitted) {
  return admitted.limits.empty() ? std::string{} : haptics::describe(admitted.limits.front());
}

lessons::CoachConfig coach_config(const SessionChoice& choice) {
  lessons::CoachConfig config;
  config.lessons = lessons::shipped_lessons();
  config.history = choice.history;
  config.no_history = choice.no_history;
  config.learner = learner_of(choice);
  config.program = base::program_name();
  return config;
}

bool same_geometry(const haptics::YokeGeometry& a, const haptics::YokeGeometry& b) {
  return a.radius == b.radius && a.theta_limit == b.theta_limit && a.phi_limit == b.phi_limit;
}

// The car state that is displayed if there is no car; contains only pedals, gear and switches.
vehicle::VehicleState standing_car(const haptics::DriverControls& controls, int gear) {
  vehicle::VehicleState car;
  car.running = false;
  car.gear = gear;
  car.pedals = controls.pedals;
  car.ignition = controls.ignition;
  return car;
}

// Describes the change that the user requests; if there are several, only the first one.
std::string_view change_reason(const ui::PanelRequests& requests) {
  if (requests.car) return "the car changed";
  if (requests.gate) return "the gate changed";
  if (requests.hand) return "the hand changed";
  return requests.preset ? "the preset changed" : "the settings changed";
}

}  // namespace

// Stops the motors first, because the destructors of other members may take long (for example, OpenAL without a sound
// card).
Session::~Session() {
  runtime_.reset();
}

Session::Session(const SessionChoice& choice)
    : choice_(choice),
      cabin_(cabin::cabin_for_camera(choice.camera)),
      coach_(coach_config(choice)),
      sound_(choice.sound),
      cabin_sound_(sound_, cabin::CabinSoundConfig{}) {
  controls_.ignition = true;
  if (choice.clock == runtime::RuntimeClock::real_time) start_ns_ = haptics::monotonic_ns();
  offer_initial(choice);
  if (choice.hand == kAutomaticHand && coach_.lesson())
    begin_lesson();
  else
    switch_to(coach_.lesson() ? with_lesson(choice, *coach_.lesson()) : choice);
  if (const std::optional<std::string> problem = coach_.take_problem()) message_ = *problem;
  why_silent_ = sound_.silence_reason();
  const bool missed = choice.sound == engine::SoundOutput::card && !why_silent_.empty();
  if (missed && message_.empty()) message_ = why_silent_;
  panel_.gates = base::shipped_names("gates");
  panel_.presets = preset_names();
  panel_.cars = base::shipped_names("cars");
  panel_.cars.emplace_back(kNoCar);
  panel_.hands = {"light", "grip", "arm", std::string(kAutomaticHand)};
  if (choice.stick) panel_.hands.clear();
  panel_.device_name = choice.stick ? choice.stick->name() : std::string(kSimulatedDevice);
}

// Returns true if a new runtime must start with forces on. Forces that the user or a fault has switched off stay off
// until the user switches them on. A real stick starts with forces only if the user switches them on in the same frame.
bool Session::should_arm() {
  if (choice_.stick) return armed_this_frame_;
  if (!runtime_) return true;
  const haptics::GuardState guard = runtime_->snapshot().guard;
  return wants_forces_ &&
         (armed_this_frame_ || (guard != haptics::GuardState::released && guard != haptics::GuardState::damped));
}

// Starts a new runtime for the choice. On failure the old runtime keeps running unchanged.
void Session::switch_to(const SessionChoice& choice, const lessons::Lesson* lesson, std::string_view reason) {
  const ResolvedCar chosen = resolve_car(choice);
  runtime::RuntimeConfig config = make_runtime_config(choice, chosen, lesson);
  if (runtime_) config.keyboard = runtime_->keyboard();
  std::unique_ptr<runtime::Runtime> runtime;
  if (!choice.stick) runtime = std::make_unique<runtime::Runtime>(config);
  const haptics::Gate gate = runtime ? runtime->gate() : check_stick(config);
  if (lesson && choice.stick) check_lever_gear(*lesson, gate);
  if (!stage_ || stage_gate_ != chosen.layout.text || !same_geometry(stage_yoke_, config.preset.lever.yoke))
    rebuild_stage(gate, chosen.layout.text, config.preset.lever.yoke, cabin_);
  message_.clear();
  const bool armed = should_arm();
  close_current(reason);
  adopt(runtime ? std::move(runtime) : replace_runtime(config), lesson);
  wants_forces_ = armed;  // if a fault ended the forces, they stay off in later calls too
  if (armed) runtime_->arm();
  running_ = choice;
  running_.car = chosen.car;
  running_.gate = chosen.gate;
  const std::string limit = describe_limit();
  if (!limit.empty()) message_ += (message_.empty() ? "" : "; ") + limit;
}

// Describes the first limited parameter. For a real stick prefers the wall stiffness, because the user feels this limit
// most.
std::string Session::describe_limit() const {
  const haptics::AdmittedTuning admitted = runtime_->admitted();
  const auto wall =
      std::find_if(admitted.limits.begin(), admitted.limits.end(), [](const haptics::TuningLimit& limited) {
        return limited.parameter == haptics::TuningParameter::wall_stiffness && limited.used < limited.wanted;
      });
  if (!running_.stick || admitted.limits.empty()) return first_limit(admitted);
  const std::string delay =
      fmt::format("{} takes {:.1f} ms to respond", running_.stick->name(), 1e3 * running_.stick->answer_time());
  if (wall == admitted.limits.end()) return delay + "; " + first_limit(admitted);
  return fmt::format("{}, so the walls were softened from {:.0f} to {:.0f} N/m", delay, wall->wanted, wall->used);
}

// Ends a running lesson early, ends recordings and ends a replay.
void Session::close_current(std::string_view reason) {
  const bool drives = coach_.view().phase == lessons::LessonPhase::driving;
  if (drives) coach_.leave();
  end_lesson_recording();
  if (recording()) end_recording();
  if (drives) report_early_end(reason);
  opening_.reset();
  player_.reset();
}

void Session::adopt(std::unique_ptr<runtime::Runtime> runtime, const lessons::Lesson* lesson) {
  runtime_ = std::move(runtime);
  runtime_->set_pedal_keys(pedals_);
  new_runtime_ = true;
  ++run_;
  if (runtime_->config().car) configure_sound(*runtime_->config().car);
  if (runtime_->config().clock == runtime::RuntimeClock::virtual_time) start_ns_ = -std::llround(1e9 * time_);
  slope_ = lesson ? lesson->start.slope : 0.0;
  is_car_held_ = false;
  if (lesson) switches_ = CarSwitches{lesson->start.running, lesson->start.hand_brake};
  if (switches_) {
    controls_.ignition = switches_->ignition;
    controls_.pedals.hand_brake = switches_->hand_brake;
  }
  runtime_->set_controls(effective_controls());
}

void Session::rebuild_stage(const haptics::Gate& gate, const std::string& text, const haptics::YokeGeometry& yoke,
                            cabin::Cabin cabin) {
  cabin::StageConfig config = cabin::stage_config(gate, yoke, cabin);
  config.drive = choice_.drive;
  stage_ = std::make_unique<cabin::Stage>(config, base::assets_folder() / "models");
  stage_gate_ = text;
  stage_yoke_ = yoke;
  cabin_ = cabin;
  new_model_ = true;
}

void Session::configure_sound(const vehicle::CarSpec& car) {
  cabin::CabinSoundConfig config = cabin_sound_.config();
  config.dog_teeth = car.synchro.teeth;
  cabin_sound_.set_config(config);
}

void Session::set_camera(std::string_view camera) {
  const cabin::Cabin cabin = cabin::cabin_for_camera(camera);
  if (cabin == cabin_) return;
  try {
    rebuild_stage(displayed_gate(), stage_gate_, stage_yoke_, cabin);
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

const haptics::Gate& Session::displayed_gate() const {
  return player_ ? player_->drive().gate() : runtime_->gate();
}

void Session::set_driver(const haptics::HandTarget& hand, const haptics::DriverControls& controls,
                         const vehicle::PedalKeys& keys) {
  runtime_->set_hand(hand);
  controls_ = controls;
  pedals_.keys = is_car_held_ ? vehicle::PedalKeys{} : keys;
  runtime_->set_pedal_keys(pedals_);
}

void Session::apply(const ui::PanelRequests& requests) {
  try {
    if (requests.stop) runtime_->stop();
    if (requests.disarm) runtime_->disarm();
    const bool arms = requests.arm && arm();
    if (requests.stop || requests.disarm || requests.arm) wants_forces_ = armed_this_frame_ = arms;
    if (requests.tuning) message_ = first_limit(runtime_->change_tuning(*requests.tuning));
    if (requests.record) toggle_recording();
    if (requests.replay) open_last_recording();
    if (requests.save_preset) save_preset(*requests.save_preset);
    apply_replay_requests(requests.playback);
    apply_choice(requests);
    apply_lesson_requests(requests.lesson);
    if (requests.compare) {
      panel_.compared.reset();
      panel_.compared = haptics::read_preset(preset_file(*requests.compare).string());
    }
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

// Applies changes of gate, car, hand, preset and configuration. Tuned parameters stay unchanged unless a preset is
// requested.
void Session::apply_choice(const ui::PanelRequests& requests) {
  if (!requests.gate && !requests.car && !requests.preset && !requests.hand && !requests.restart) return;
  SessionChoice wanted = choice_;
  if (wanted.car.empty()) wanted.car = kDefaultCar;
  wanted.haptics = runtime_->config().preset.haptics;
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
  switch_to(wanted, nullptr, change_reason(requests));
  choice_ = wanted;
  if (coach_.view().learner != learner_of(choice_)) coach_.set_learner(learner_of(choice_));
}

void Session::advance(double seconds) {
  time_ += seconds;
  armed_this_frame_ = false;
  poll_stick();
  runtime_->set_controls(effective_controls());
  if (running_.clock == runtime::RuntimeClock::virtual_time) runtime_->advance(seconds);
  report_recording_problem();
  drain_events();
  drain_cycles();
  update_shown();
  finish_opening();
  if (player_) show_replay(seconds);
}

void Session::drain_events() {
  events_ = runtime_->drain_events();
  for (haptics::HapticEvent& event : events_) event.time_ns -= start_ns_;
}

void Session::drain_cycles() {
  const std::vector<vehicle::DriveSample> cycles = runtime_->drain_cycles();
  if (!cycles.empty()) newest_controls_ = cycles.back().controls;
  update_lesson(cycles);
  history_ = plot_samples(cycles);
}

// Call after drain_cycles(), so that the displayed state is not older than the history.
void Session::update_shown() {
  shown_ = runtime_->snapshot();
  const double apart = glm::distance(shown_.lever, shown_.proxy) + visual_offset_;
  if (visual_offset_ > 0.0 && apart > runtime_->config().preset.haptics.ghost_offset)
    shown_.flags |= haptics::kFlagGhost;
  newest_ns_ = shown_.time_ns;
  car_ = runtime_->config().car ? runtime_->car() : standing_car(newest_controls_, shown_.gear);
}

void Session::update_cabin() {
  cabin::StageInput input{shown_, car_, time_};
  input.pointer = pointer_;
  if (player_ && player_->shift()) {
    const lessons::RecordedShift& shift = player_->drive().shifts()[*player_->shift()];
    input.driven_path = shift.driven;
    input.ideal_path = shift.ideal;
  }
  stage_->place(input);
  if (stage_->take_dial_change()) new_model_ = true;
  const glm::vec3 knob = stage_->knob();
  if (!player_)
    for (const haptics::HapticEvent& event : events_) cabin_sound_.on_event(event, knob);
  cabin_sound_.update(shown_, car_, ears_, knob, time_);
  report_sound();
}

// Reports once when sound is lost, and once when it is back.
void Session::report_sound() {
  if (sound_.silence_reason() == why_silent_) return;
  why_silent_ = sound_.silence_reason();
  message_ = why_silent_.empty() ? "the sound works again" : why_silent_;
}

bool Session::take_new_runtime() {
  return std::exchange(new_runtime_, false);
}

bool Session::take_new_model() {
  return std::exchange(new_model_, false);
}

std::optional<CarSwitches> Session::take_switches() {
  return std::exchange(switches_, std::nullopt);
}

void Session::save_preset(const std::string& name) {
  const fs::path file = user_preset_file(name);
  haptics::Preset preset = runtime_->config().preset;
  preset.name = name;
  haptics::write_preset(preset, file);
  choice_.preset = running_.preset = name;
  panel_.presets = preset_names();
  message_ = fmt::format("preset saved as {}", file.string());
}

ui::PanelInput Session::panel_input() {
  const lessons::CoachView& coach = coach_.view();
  const bool is_automatic_hand = running_.hand == kAutomaticHand;
  panel_.health = runtime_->health();
  panel_.opening = opening_ ? opening_->file().filename().string() : std::string();
  return {.gate = displayed_gate(),
          .device = runtime_->device(),
          .haptics = runtime_->config().preset.haptics,
          .admitted = runtime_->admitted(),
          .now = shown_,
          .run = run_,
          .history = history_,
          .events = player_ ? std::span<const haptics::HapticEvent>() : events_,
          .health = panel_.health,
          .car = car_,
          .gate_name = running_.gate,
          .preset_name = running_.preset,
          .hand_name = running_.stick          ? "your own"
                       : running_.hand.empty() ? "from preset"
                                               : std::string_view(running_.hand),
          .device_name = panel_.device_name,
          .stick = running_.stick ? std::optional(ui::StickView{is_stick_connected_, running_.stick->answer_time()})
                                  : std::nullopt,
          .gates = panel_.gates,
          .presets = panel_.presets,
          .hands = panel_.hands,
          .compared = panel_.compared ? &*panel_.compared : nullptr,
          .recording = runtime_->is_recording(),
          .message = message_,
          .frame_ms = frame_ms_,
          .car_name = running_.car,
          .cars = panel_.cars,
          .coach = coach,
          .replay = player_ ? &*player_ : nullptr,
          .opening = panel_.opening,
          .keys = panel_.keys,
          .mouse_moves_lever = panel_.mouse_moves_lever,
          .is_automatic_hand = is_automatic_hand,
          .instructor_holds_pedals = is_car_held_ && !is_automatic_hand,
          .is_unpassable = is_unpassable_ && coach.phase == lessons::LessonPhase::driving,
          .headset = panel_.headset ? &*panel_.headset : nullptr};
}

}  // namespace gearshift::session
