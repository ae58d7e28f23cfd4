#include "app/session/session.h"

#include <memory>
#include <utility>

#include "app/base/assets_path.h"
#include "app/lessons/assessment/gate_path.h"
#include "app/runtime/thin_out.h"
#include "app/session/preset_store.h"
#include "app/session/resolve_choice.h"
#include "haptics/rt/monotonic_clock.h"

namespace gearshift::session {
namespace {

constexpr std::size_t kPlotSamples = 200;  // largest number of snapshots of a frame that the plots draw

// The car state that is displayed if there is no car; contains only pedals, gear and switches.
vehicle::VehicleState standing_car(const haptics::DriverControls& controls, int gear) {
  vehicle::VehicleState car;
  car.running = false;
  car.gear = gear;
  car.pedals = controls.pedals;
  car.ignition = controls.ignition;
  return car;
}

}  // namespace

Session::Session(const SessionChoice& choice)
    : director_(choice),
      recorder_(choice.history),
      cabin_(cabin::cabin_for_camera(choice.camera)),
      sound_(choice.sound),
      cabin_sound_(sound_, cabin::CabinSoundConfig{}),
      lever_(choice) {
  if (choice.clock == runtime::RuntimeClock::real_time) start_ns_ = haptics::monotonic_ns();
  const lessons::Lesson* lesson = director_.coach().lesson();
  if (choice.hand == kAutomaticHand && lesson != nullptr)
    begin_lesson();
  else if (lesson != nullptr)
    offer_in_its_gate(choice, *lesson);
  else
    switch_to(choice);
  if (!choice.server.empty() && !choice.history.empty()) server_link_.emplace(choice.history, choice.server);
  if (const std::optional<std::string> problem = director_.coach().take_problem()) message_ = *problem;
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

void Session::offer_in_its_gate(const SessionChoice& choice, const lessons::Lesson& lesson) {
  const SessionChoice wanted = with_lesson(choice, lesson);
  switch_to(wanted);
  add_message(describe_replaced_gate(choice, wanted, lesson));
}

void Session::rebuild_stage(const haptics::Gate& gate, const std::string& text, const haptics::YokeGeometry& yoke,
                            cabin::Cabin cabin) {
  cabin::StageConfig config = cabin::stage_config(gate, yoke, cabin);
  config.drive = lever_.choice().drive;
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

// The events of this frame, unless a replay is shown in place of the lever.
std::span<const haptics::HapticEvent> Session::live_events() const {
  return is_replaying() ? std::span<const haptics::HapticEvent>() : events_;
}

const haptics::Gate& Session::displayed_gate() const {
  return viewer_.player() != nullptr ? viewer_.player()->drive().gate() : lever_.runtime().gate();
}

void Session::advance(double seconds) {
  time_ += seconds;
  if (const std::string news = lever_.begin_frame(director_.controls()); !news.empty()) message_ = news;
  if (lever_.running().clock == runtime::RuntimeClock::virtual_time) lever_.runtime().advance(seconds);
  if (const std::optional<std::string> problem = recorder_.poll_problem(lever_.runtime())) message_ = *problem;
  follow(lever_.runtime().read_frame());
  if (const auto news = server_link_ ? server_link_->take_message() : std::nullopt) message_ = *news;
  finish_opening();
  if (viewer_.player() != nullptr) show_replay(seconds);
  find_way();
}

// While the lesson wants a gear that is not engaged.
void Session::find_way() {
  const int gear = director_.coach().prompted_gear();
  way_.clear();
  if (is_replaying() || gear == haptics::kNeutralGear || gear == shown_.gear) return;
  const haptics::Gate& gate = lever_.runtime().gate();
  way_ = lessons::shortest_path(gate, shown_.proxy, haptics::rest_position(gate, gear));
}

// Judges the lesson, and takes lever, car and events for this frame's pictures and sounds.
void Session::follow(runtime::RuntimeFrame frame) {
  events_ = std::move(frame.events);
  for (haptics::HapticEvent& event : events_) event.time_ns -= start_ns_;
  if (!frame.cycles.empty()) newest_controls_ = frame.cycles.back().controls;
  if (lever_.are_pedal_keys_held()) director_.coach().judge_by_errors();
  if (director_.add(frame.cycles)) end_lesson();
  if (const std::optional<std::string> problem = director_.coach().take_problem()) message_ = *problem;
  runtime::thin_out(frame.cycles, kPlotSamples, history_);
  newest_ns_ = frame.lever.time_ns;
  shown_ = frame.lever;
  const runtime::RuntimeConfig& config = lever_.runtime().config();
  const double apart = glm::distance(shown_.lever, shown_.proxy) + visual_offset_;
  if (visual_offset_ > 0.0 && apart > config.preset.haptics.ghost_offset) shown_.flags |= haptics::kFlagGhost;
  car_ = config.car ? frame.car : standing_car(newest_controls_, shown_.gear);
}

void Session::update_cabin(const engine::EyePose& ears, const std::optional<cabin::Beam>& pointer) {
  cabin::StageInput input{shown_, car_, time_};
  input.pointer = pointer;
  if (const lessons::RecordedShift* shift = viewer_.shift()) {
    input.driven_path = shift->driven;
    input.ideal_path = shift->ideal;
  } else {
    input.ideal_path = way_;
  }
  stage_->place(input);
  if (stage_->take_dial_change()) new_model_ = true;
  const glm::vec3 knob = stage_->knob();
  cabin_sound_.set_bite_tick(director_.coach().pedal_help());
  cabin_sound_.update(live_events(), shown_, car_, ears, knob, time_);
  report_sound();
}

// Reports once when sound is lost, and once when it is back.
void Session::report_sound() {
  if (sound_.silence_reason() == why_silent_) return;
  why_silent_ = sound_.silence_reason();
  message_ = why_silent_.empty() ? "the sound works again" : why_silent_;
}

bool Session::take_new_model() {
  return std::exchange(new_model_, false);
}

void Session::finish_opening() {
  if (!viewer_.is_opened()) return;
  try {
    show_opened();
  } catch (const std::exception& refused) {
    message_ = refused.what();
  }
}

// Displays the state from the trace, except for the guard, whose live state must stay visible.
void Session::show_replay(double seconds) {
  lessons::Player& player = *viewer_.player();
  if (player.has_jumped()) ++run_;
  (void)player.advance(seconds);
  const haptics::GuardState guard = shown_.guard;
  const haptics::GuardFault fault = shown_.fault;
  shown_ = player.now().lever;
  shown_.guard = guard;
  shown_.fault = fault;
  car_ = player.now().car;
  runtime::thin_out(player.passed(), kPlotSamples, history_);
}

ui::PanelInput Session::panel_input() const {
  const lessons::CoachView& coach = director_.view();
  const SessionChoice& running = lever_.running();
  const runtime::Runtime& runtime = lever_.runtime();
  const bool is_automatic_hand = running.hand == kAutomaticHand;
  return {.gate = displayed_gate(),
          .device = runtime.device(),
          .haptics = runtime.config().preset.haptics,
          .admitted = runtime.admitted(),
          .now = shown_,
          .run = run_,
          .history = history_,
          .events = live_events(),
          .health = runtime.health(),
          .car = car_,
          .gate_name = running.gate,
          .preset_name = running.preset,
          .hand_name = running.stick          ? "your own"
                       : running.hand.empty() ? "from preset"
                                              : std::string_view(running.hand),
          .device_name = panel_.device_name,
          .stick = running.stick
                       ? std::optional(ui::StickView{lever_.is_stick_connected(), running.stick->answer_time()})
                       : std::nullopt,
          .gates = panel_.gates,
          .presets = panel_.presets,
          .hands = panel_.hands,
          .compared = panel_.compared ? &*panel_.compared : nullptr,
          .recording = runtime.is_recording(),
          .message = message_,
          .frame_ms = frame_ms_,
          .car_name = running.car,
          .cars = panel_.cars,
          .coach = coach,
          .replay = viewer_.player(),
          .opening = viewer_.opening_name(),
          .keys = panel_.keys,
          .mouse_moves_lever = panel_.mouse_moves_lever,
          .is_automatic_hand = is_automatic_hand,
          .instructor_holds_pedals = lever_.is_car_held() && !is_automatic_hand,
          .is_unpassable = director_.is_unpassable(),
          .headset = panel_.headset ? &*panel_.headset : nullptr,
          .wanted = is_replaying() ? nullptr : director_.coach().prompted_step(),
          .wanted_gear = way_.empty() ? haptics::kNeutralGear : director_.coach().prompted_gear(),
          .way = way_,
          .reply = panel_.reply,
          .held_throttle = panel_.held_throttle,
          .engine = runtime.config().car ? &runtime.config().car->engine : nullptr};
}

}  // namespace gearshift::session
