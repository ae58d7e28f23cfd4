#include "app/cabin/sound/cabin_sound.h"

#include <algorithm>
#include <utility>

#include "app/cabin/sound/car_synth.h"
#include "app/cabin/sound/synth.h"
#include "haptics/files/parameter.h"

namespace gearshift::cabin {

namespace {

// Place of the engine's sound: ahead of the dashboard, 0.2 m to the driver's right. The real engine is in the car's
// middle, 0.37 m to the right, but its sound comes from the whole bulkhead.
constexpr glm::vec3 kEnginePlace{0.2f, 0.2f, -1.5f};  // [m]
constexpr glm::vec3 kCluster{0.0f, 0.37f, -0.70f};    // [m]
constexpr float kWarningGain = 0.55f, kOverRevGain = 0.45f;
// [s] From coasting to full load. OpenAL Soft 1.24 applies a new gain almost at once, where 1.19 took a whole update: a
// step of the load then clicks, with twice the sharpest bend of the engine's own wave.
constexpr double kLoadTime = 0.065;
constexpr float kWarningRadius = 0.5f;  // [m] so large that both ears hear the warning in every head pose

}  // namespace

CabinSound::CabinSound(engine::SoundWorld& world, const CabinSoundConfig& config)
    : world_(world),
      config_(config),
      knock_(world.add_clip(wall_knock())),
      gear_in_(world.add_clip(gear_in_click())),
      gear_out_(world.add_clip(gear_out_click())),
      car_(world),
      over_push_{start_silent_loop(world, over_push_loop()), {kWarningLength, 0.0}},
      saturation_{start_silent_loop(world, saturation_loop()), {kWarningLength, kSaturationHold}},
      over_rev_{start_silent_loop(world, over_rev_loop()), {kWarningLength, kSaturationHold}} {
  set_config(config);
}

void CabinSound::set_config(const CabinSoundConfig& config) {
  for (const auto& [cylinders, engine] : engines_) engine.set(world_, 0.0, 0.0, 0.0, kEnginePlace);
  config_ = config;
  config_.cylinders = std::clamp(config.cylinders, 1, 12);
  if (config_.engine) engine_voices();  // synthesised here, because synthesis in update() would delay a frame
  world_.set_volume(config_.volume);
}

void CabinSound::on_event(const haptics::HapticEvent& event, glm::vec3 knob) {
  switch (event.kind) {
    case haptics::EventKind::wall_contact: {
      // The gain is proportional to the impact speed, like the peak force when a mass hits a spring.
      const double gain = std::clamp(event.value / config_.loudest_impact, 0.0, 1.0);
      return world_.play(knock_, {knob, static_cast<float>(gain)});
    }
    case haptics::EventKind::gear_engaged:
      return world_.play(gear_in_, {knob});
    case haptics::EventKind::gear_left:
      return world_.play(gear_out_, {knob});
    case haptics::EventKind::over_push_begin:
      return over_push_.hold.begin();
    case haptics::EventKind::saturation_begin:
      return saturation_.hold.begin();
    default:
      return;  // silent; update() reads the end of a warning from the snapshot's flags
  }
}

void CabinSound::update(std::span<const haptics::HapticEvent> events, const haptics::HapticSnapshot& lever,
                        const vehicle::VehicleState& car, const engine::EyePose& ears, glm::vec3 knob, double time) {
  for (const haptics::HapticEvent& event : events) on_event(event, knob);
  update_listener(ears);
  update_engine(car, time);
  car_.set(world_, car, config_.engine, config_.dog_teeth, {kEnginePlace, knob, kCluster}, time);
  update_warning(over_push_, (lever.flags & haptics::kFlagOverPush) != 0, {knob, kWarningGain}, time);
  update_warning(saturation_, (lever.flags & haptics::kFlagSaturated) != 0, {knob, kWarningGain}, time);
  update_warning(over_rev_, car.over_revved, {kCluster, kOverRevGain}, time);
  world_.update(time);
}

const EngineVoices& CabinSound::engine_voices() {
  return engines_.try_emplace(config_.cylinders, world_, config_.cylinders).first->second;
}

void CabinSound::update_listener(const engine::EyePose& ears) {
  const glm::dvec3 forward = ears.orientation * glm::dvec3(0.0, 0.0, -1.0);
  const glm::dvec3 up = ears.orientation * glm::dvec3(0.0, 1.0, 0.0);
  world_.set_listener(glm::vec3(ears.position), glm::vec3(forward), glm::vec3(up));
}

void CabinSound::update_engine(const vehicle::VehicleState& car, double time) {
  const double step = std::max(0.0, time - std::exchange(updated_at_, time)) / kLoadTime;
  load_ += std::clamp(car.engine_load - load_, -step, step);
  if (!config_.engine) return;
  const double speed = std::abs(car.engine_speed) / haptics::kTurnPerMinute;  // [1/min]
  engine_voices().set(world_, speed, load_, 1.0, kEnginePlace);
}

void CabinSound::update_warning(Warning& warning, bool lasts, engine::Voice as, double time) {
  const WarningHold::Now now = warning.hold.update(lasts, time);
  if (now.starts) world_.restart(warning.voice);
  if (!now.is_audible) as.gain = 0.0f;
  as.radius = kWarningRadius;
  world_.set(warning.voice, as);
}

}  // namespace gearshift::cabin
