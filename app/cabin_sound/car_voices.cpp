#include "app/cabin_sound/car_voices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/cabin_sound/car_synth.h"

namespace gearshift {

namespace {

constexpr double kLeastGrind = 0.32, kMostGrind = 0.50;  // [1]
constexpr double kLoudGrind = 100.0;                     // [W] of a hand that leans on it
constexpr double kStarterGain = 0.30, kJudderGain = 0.60, kLimiterGain = 0.22, kChimeGain = 0.8;  // [1]
constexpr double kCutHold = 0.12;                                                                 // [s]
constexpr float kChimeRadius = 0.5f;                                                              // [m] for both ears

// The speed that a loop is made for, and the speed that it is heard at.
float pitch_of(double speed, double made_at) {
  return static_cast<float>(speed / made_at);
}

double rpm(const VehicleState& car) {
  return car.engine_speed * 30.0 / std::numbers::pi;
}

}  // namespace

VoiceId silent_loop(SoundWorld& world, const std::vector<float>& samples) {
  return world.loop(world.add_clip(samples), {.gain = 0.0f});
}

double tooth_pass_rate(double difference, double teeth) noexcept {
  return std::abs(difference) * teeth / (2.0 * std::numbers::pi);
}

double grind_gain(double power) noexcept {
  return kLeastGrind + (kMostGrind - kLeastGrind) * std::sqrt(std::clamp(power / kLoudGrind, 0.0, 1.0));
}

CarVoices::CarVoices(SoundWorld& world)
    : grind_(silent_loop(world, grind_loop())),
      starter_(silent_loop(world, starter_loop())),
      judder_(silent_loop(world, judder_loop())),
      limiter_(silent_loop(world, limiter_loop())),
      chime_(world.add_clip(stall_chime())),
      cut_(kCutHold, kCutHold) {}

void CarVoices::set(SoundWorld& world, const VehicleState& car, bool engine, double teeth, const Place& at,
                    double time) {
  const double grind = car.grinding ? grind_gain(car.grind_power) : 0.0;
  world.set(grind_,
            {at.knob, static_cast<float>(grind), pitch_of(tooth_pass_rate(car.dog_difference, teeth), kGrindLoopRate)});
  sound_engine(world, car, engine, at.engine, time);
  announce_stall(world, car, at.cluster);
}

void CarVoices::sound_engine(SoundWorld& world, const VehicleState& car, bool engine, glm::vec3 place, double time) {
  const auto gain = [engine](bool on, double loudness) { return static_cast<float>(engine && on ? loudness : 0.0); };
  const bool cuts = cut_.update(car.fuel_cut, time).heard;
  world.set(starter_, {place, gain(car.cranking, kStarterGain), pitch_of(rpm(car), kStarterLoopSpeed)});
  world.set(judder_, {place, gain(true, kJudderGain * car.shudder), pitch_of(rpm(car), kJudderLoopSpeed)});
  world.set(limiter_, {place, gain(cuts, kLimiterGain), 1.0f});
}

// Once. What had stalled when this began, nobody heard die.
void CarVoices::announce_stall(SoundWorld& world, const VehicleState& car, glm::vec3 place) {
  if (car.stalled && !stalled_)
    world.play(chime_, {.position = place, .gain = static_cast<float>(kChimeGain), .radius = kChimeRadius});
  stalled_ = car.stalled;
}

}  // namespace gearshift
