#include "app/session/lever_in_force.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

#include "app/base/program_name.h"
#include "app/lessons/assessment/lever_path_text.h"
#include "app/lessons/simulated_driver/auto_driver.h"
#include "app/session/preset_store.h"
#include "haptics/contact/proxy.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/gate/gear_selector.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/preset.h"

namespace gearshift::session {
namespace {

haptics::Preset resolve_preset(const SessionChoice& choice) {
  haptics::Preset preset = haptics::read_preset(preset_file(choice.preset).string());
  if (choice.haptics) preset.haptics = *choice.haptics;
  if (choice.hand.empty() || choice.hand == kAutomaticHand) return preset;
  const std::optional<haptics::HandImpedance> hand = haptics::parse_hand(choice.hand);
  if (!hand || hand->stiffness < haptics::kMinLeadingStiffness)
    throw std::invalid_argument(fmt::format(
        "\"{}\" is not a valid hand: use light, grip, arm, \"{}\" or M,B,K (kg, N s/m and N/m, with a stiffness of at "
        "least {:g} N/m)",
        choice.hand, kAutomaticHand, haptics::kMinLeadingStiffness));
  preset.lever.hand = *hand;
  return preset;
}

// The hand "by itself" drives the lesson or, without a lesson, shifts through all gears again and again.
runtime::DriverFunction automatic_driver(const runtime::RuntimeConfig& runtime, const vehicle::CarSpec& car,
                                         const lessons::Lesson* lesson) {
  const haptics::YokeGeometry& yoke = runtime.preset.lever.yoke;
  lessons::AutoDriverConfig config;
  config.gate = haptics::compile_gate(runtime.layout, haptics::workspace_half_extent(yoke), yoke.radius);
  config.car = car;
  config.lesson = lesson ? *lesson : lessons::tour_lesson(car, config.gate);
  config.again = lesson == nullptr;
  config.seed = runtime.seed;
  config.period = haptics::period_s(runtime.preset.haptics);
  const auto driver = std::make_shared<lessons::AutoDriver>(config);
  return [driver](const vehicle::DriveSample& sample) { return driver->act(sample); };
}

// `lesson`: defines the car's state at the start. If it is null, the car is parked.
runtime::RuntimeConfig make_runtime_config(const SessionChoice& choice, const ResolvedCar& chosen,
                                           const lessons::Lesson* lesson) {
  runtime::RuntimeConfig config;
  config.preset = resolve_preset(choice);
  config.layout = chosen.layout;
  config.car = chosen.spec;
  config.clock = choice.clock;
  config.seed = choice.seed;
  config.pedal_timing = choice.pedal_timing;
  config.program = base::program_name();
  config.watch = choice.watch;
  if (lesson) {
    config.start = lessons::car_start(lesson->start);
    config.pedals.hand_brake = lesson->start.hand_brake;
    config.pedals.brake = lesson->start.brake;
  }
  if (choice.stick) config.lever = [stick = choice.stick](double period) { return stick->lever(period); };
  if (choice.hand != kAutomaticHand) return config;
  if (choice.stick)
    throw std::invalid_argument("hand \"by itself\" works only with the simulated lever, not with a stick");
  if (config.layout.sequential_gears > 0)
    throw std::invalid_argument(
        "hand \"by itself\" needs a gate with a slot for each gear, and this one is sequential; choose another gate or "
        "another hand");
  if (!config.car) throw std::invalid_argument("hand \"by itself\" needs a car; choose a car or another hand");
  config.driver = automatic_driver(config, *config.car, lesson);
  return config;
}

}  // namespace

std::string first_limit(const haptics::AdmittedTuning& admitted) {
  return admitted.limits.empty() ? std::string{} : haptics::describe(admitted.limits.front());
}

LeverInForce::Next LeverInForce::prepare(const SessionChoice& choice, const lessons::Lesson* lesson) const {
  const ResolvedCar chosen = resolve_car(choice);
  Next next{choice, chosen.layout.text, make_runtime_config(choice, chosen, lesson), nullptr, {}, {}};
  next.choice.car = chosen.car;
  next.choice.gate = chosen.gate;
  if (!next.config.driver) hand_over_pedals(next.config);
  if (choice.stick) {
    runtime::RuntimeConfig detached = next.config;  // checked while the old runtime still drives the stick
    detached.lever = [&choice](double period) { return choice.stick->detached_lever(period); };
    next.gate = runtime::check_runtime(detached);
    if (lesson != nullptr) check_lever_gear(*lesson, next.gate);
  } else {
    next.runtime = std::make_unique<runtime::Runtime>(next.config);
    next.gate = next.runtime->gate();
  }
  if (lesson != nullptr)
    next.switches = CarSwitches{lesson->start.running, lesson->start.hand_brake, lesson->start.brake};
  return next;
}

void LeverInForce::hand_over(Next next, const SessionChoice* chosen) {
  const bool has_forces = wants_forces_after_hand_over();
  runtime_ = next.runtime ? std::move(next.runtime) : replace_runtime(next.config);
  is_new_ = true;
  is_car_held_ = false;
  start_brake_ = next.switches && !runtime_->config().driver ? next.switches->brake : 0.0;
  running_ = std::move(next.choice);
  if (chosen != nullptr) choice_ = *chosen;
  if (next.switches) switches_ = next.switches;
  if (switches_) {
    controls_.ignition = switches_->ignition;
    controls_.pedals.hand_brake = switches_->hand_brake;
  }
  if (has_forces) runtime_->arm();
}

bool LeverInForce::wants_forces_after_hand_over() {
  using runtime::ForceCause;
  const ForceCause cause = !runtime_         ? ForceCause::start
                           : has_just_armed_ ? ForceCause::new_lever_of_armed
                                             : ForceCause::new_lever;
  return runtime::wants_forces_after(cause, choice_.stick != nullptr, runtime_ && runtime_->wants_forces());
}

// The learner's feet stay where they are. A pedal that the instructor holds is not the learner's.
void LeverInForce::hand_over_pedals(runtime::RuntimeConfig& config) const {
  const haptics::Pedals start = config.pedals;
  config.pedals = controls_.pedals;
  config.pedals.hand_brake = start.hand_brake;
  config.pedals.brake = std::max(config.pedals.brake, start.brake);
  config.pedal_keys = keys_;
  if (runtime_ && !is_car_held_) config.keyboard = runtime_->keyboard();
}

// Ends the old runtime before creating the new one, because only one runtime may use the stick. The new configuration
// has already been checked; if the new runtime fails anyway, the old one is created again.
std::unique_ptr<runtime::Runtime> LeverInForce::replace_runtime(const runtime::RuntimeConfig& config) {
  if (!runtime_) return std::make_unique<runtime::Runtime>(config);
  const runtime::RuntimeConfig before = runtime_->config();
  runtime_.reset();
  try {
    return std::make_unique<runtime::Runtime>(config);
  } catch (...) {
    is_new_ = true;
    runtime_ = old_runtime(before);
    throw;
  }
}

// The lever that was in force, without forces. If the stick has just failed, the lever has no connection to it.
std::unique_ptr<runtime::Runtime> LeverInForce::old_runtime(runtime::RuntimeConfig config) const {
  try {
    return std::make_unique<runtime::Runtime>(config);
  } catch (const std::exception&) {
    config.lever = [stick = choice_.stick](double period) { return stick->detached_lever(period); };
    return std::make_unique<runtime::Runtime>(config);
  }
}

// Throws unless the real stick is in the lesson's starting gear, because only the user can move a real stick.
void LeverInForce::check_lever_gear(const lessons::Lesson& lesson, const haptics::Gate& gate) const {
  if (!runtime_) return;
  if (!choice_.stick->connected())
    throw std::runtime_error(
        fmt::format("{} is not plugged in. Plug it in, then start the lesson.", choice_.stick->name()));
  haptics::GearSelector at_once(0.0);
  const int gear = at_once.update(gate, haptics::place_proxy(gate, runtime_->snapshot().lever).position, 0.0);
  if (gear == lesson.start.gear) return;
  throw std::runtime_error(fmt::format("the lesson starts in {0}, but the stick is in {1}. Move it to {0}, then start.",
                                       lessons::gear_word(lesson.start.gear), lessons::gear_word(gear)));
}

// A stick must not start to push when it is plugged in, so it cannot be armed before.
bool LeverInForce::arm() {
  if (choice_.stick && !choice_.stick->connected()) return false;
  has_just_armed_ = true;
  runtime_->arm();
  return true;
}

void LeverInForce::disarm() {
  has_just_armed_ = false;
  runtime_->disarm();
}

void LeverInForce::stop() {
  has_just_armed_ = false;
  runtime_->stop();
}

std::string LeverInForce::begin_frame(const LessonControls& lesson) {
  has_just_armed_ = false;
  std::string news;
  if (choice_.stick) {
    while (const std::optional<std::string> one = choice_.stick->take_message())
      news += (news.empty() ? "" : "; ") + *one;
    const bool was_there = std::exchange(is_stick_connected_, choice_.stick->connected());
    if (was_there && !is_stick_connected_) runtime_->follow(runtime::ForceCause::stick_lost);
  }
  send_controls(lesson);
  return news;
}

void LeverInForce::set_driver(const haptics::HandTarget& hand, const haptics::DriverControls& controls,
                              const haptics::PedalKeys& keys) {
  runtime_->set_hand(hand);
  controls_ = controls;
  keys_ = keys;
}

// After a lesson the instructor presses the clutch and brakes the car to a stop.
void LeverInForce::send_controls(const LessonControls& lesson) {
  haptics::DriverControls controls = controls_;
  haptics::PedalKeys keys = keys_;
  keys.slow_clutch = lesson.pedal_help;
  if (is_car_held_) {
    keys = {.clutch = true};
    controls.pedals.throttle = 0.0;
    controls.pedals.brake = std::max(controls.pedals.brake, 0.5);
  }
  const double pressed = std::max(controls.pedals.brake, runtime_->keyboard().brake);
  if (pressed >= start_brake_) start_brake_ = 0.0;
  controls.pedals.brake = std::max(controls.pedals.brake, start_brake_);
  controls.slope = lesson.slope;
  controls.guidance = lesson.guidance;
  controls.guided_gear = lesson.guided_gear;
  runtime_->set_controls(controls, keys);
}

// For a real stick prefers the wall stiffness, because the user feels this limit most.
std::string LeverInForce::describe_limit() const {
  const haptics::AdmittedTuning& admitted = runtime_->admitted();
  if (!running_.stick || admitted.limits.empty()) return first_limit(admitted);
  const auto wall =
      std::find_if(admitted.limits.begin(), admitted.limits.end(), [](const haptics::TuningLimit& limited) {
        return limited.parameter == &haptics::HapticTuning::wall_stiffness && limited.used < limited.wanted;
      });
  const std::string delay =
      fmt::format("{} takes {:.1f} ms to respond", running_.stick->name(), 1e3 * running_.stick->answer_time());
  if (wall == admitted.limits.end()) return delay + "; " + first_limit(admitted);
  return fmt::format("{}, so the walls were softened from {:.0f} to {:.0f} N/m", delay, wall->wanted, wall->used);
}

}  // namespace gearshift::session
