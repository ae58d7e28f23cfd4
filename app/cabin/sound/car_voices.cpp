#include "app/cabin/sound/car_voices.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/cabin/sound/car_synth.h"
#include "haptics/files/parameter.h"

namespace gearshift::cabin {

namespace {

constexpr double kMinGrindGain = 0.32, kMaxGrindGain = 0.50;  // [1]
constexpr double kLoudGrind = 100.0;                          // [W] from this power on, the gain is kMaxGrindGain
constexpr double kStarterGain = 0.30, kJudderGain = 0.60, kLimiterGain = 0.22, kChimeGain = 0.8,
                 kTickGain = 0.5;     // [1]
constexpr double kCutHold = 0.12;     // [s] longer than the pauses between the limiter's fuel cuts
constexpr float kChimeRadius = 0.5f;  // [m] so large that both ears hear the chime

// Playback pitch that makes a loop for `loop_speed` sound like one for `speed`.
float pitch_of(double speed, double loop_speed) {
  return static_cast<float>(speed / loop_speed);
}

double rpm(const vehicle::VehicleState& car) {
  return std::abs(car.engine_speed) / haptics::kTurnPerMinute;
}

}  // namespace

engine::VoiceId start_silent_loop(engine::SoundWorld& world, const std::vector<float>& samples) {
  return world.loop(world.add_clip(samples), {.gain = 0.0f});
}

double tooth_pass_rate(double difference, double teeth) noexcept {
  return std::abs(difference) * teeth / (2.0 * std::numbers::pi);
}

double grind_gain(double power) noexcept {
  return kMinGrindGain + (kMaxGrindGain - kMinGrindGain) * std::sqrt(std::clamp(power / kLoudGrind, 0.0, 1.0));
}

CarVoices::CarVoices(engine::SoundWorld& world)
    : grind_(start_silent_loop(world, grind_loop())),
      starter_(start_silent_loop(world, starter_loop())),
      judder_(start_silent_loop(world, judder_loop())),
      limiter_(start_silent_loop(world, limiter_loop())),
      chime_(world.add_clip(stall_chime())),
      tick_(world.add_clip(bite_tick())),
      cut_(kCutHold, kCutHold) {}

void CarVoices::set(engine::SoundWorld& world, const vehicle::VehicleState& car, bool engine, double teeth,
                    const Place& at, double time) {
  const double grind = car.grinding ? grind_gain(car.grind_power) : 0.0;
  world.set(grind_,
            {at.knob, static_cast<float>(grind), pitch_of(tooth_pass_rate(car.dog_difference, teeth), kGrindLoopRate)});
  update_engine(world, car, engine, at.engine, time);
  play_stall_chime(world, car, at.cluster);
  play_bite_tick(world, car, at.cluster);
}

void CarVoices::update_engine(engine::SoundWorld& world, const vehicle::VehicleState& car, bool engine, glm::vec3 place,
                              double time) {
  const auto gain = [engine](bool on, double loudness) { return static_cast<float>(engine && on ? loudness : 0.0); };
  const bool cuts = cut_.update(car.fuel_cut, time).is_audible;
  world.set(starter_, {place, gain(car.cranking, kStarterGain), pitch_of(rpm(car), kStarterLoopSpeed)});
  world.set(judder_, {place, gain(true, kJudderGain * car.shudder), pitch_of(rpm(car), kJudderLoopSpeed)});
  world.set(limiter_, {place, gain(cuts, kLimiterGain), 1.0f});
}

void CarVoices::play_bite_tick(engine::SoundWorld& world, const vehicle::VehicleState& car, glm::vec3 place) {
  const bool is_above = car.pedals.clutch < car.clutch_bite;
  if (std::exchange(is_above_bite_, is_above) != is_above && bite_tick_ > 0.0)
    world.play(tick_, {.position = place, .gain = static_cast<float>(kTickGain * bite_tick_), .radius = kChimeRadius});
}

// Plays the chime once per stall, but not for a car that had already stalled at the start.
void CarVoices::play_stall_chime(engine::SoundWorld& world, const vehicle::VehicleState& car, glm::vec3 place) {
  if (car.stalled && !stalled_)
    world.play(chime_, {.position = place, .gain = static_cast<float>(kChimeGain), .radius = kChimeRadius});
  stalled_ = car.stalled;
}

}  // namespace gearshift::cabin
