// The cabin's sounds, rendered to memory as the driver hears them.
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "app/cabin/sound/cabin_sound.h"
#include "tests/engine/sound/measure.h"

namespace gearshift::test {

inline constexpr glm::vec3 kKnob{0.37f, 0.35f, -0.25f};
inline constexpr double kFrame = 1.0 / 60.0;

inline vehicle::VehicleState running(double speed, double load) {  // `speed` in [rpm], `load` in [1]
  vehicle::VehicleState car;
  car.engine_speed = speed * std::numbers::pi / 30.0;
  car.engine_load = load;
  return car;
}

// The cabin's sounds, heard by a driver at the wheel.
struct Cabin {
  engine::SoundWorld world{engine::SoundOutput::memory};
  cabin::CabinSound sound;
  haptics::HapticSnapshot lever;
  vehicle::VehicleState car;
  engine::EyePose ears = engine::look_at({0.0, 0.65, 0.0}, {0.0, 0.65, -1.0});
  glm::vec3 knob = kKnob;
  double time = 0.0;
  std::vector<haptics::HapticEvent> events;  // of the next frame

  explicit Cabin(const cabin::CabinSoundConfig& config = {}) : sound(world, config) {}

  void on_event(haptics::EventKind kind, double value = 0.0) { events.push_back({kind, 0, 0, value}); }

  std::vector<float> run(double seconds) {
    std::vector<float> all;
    for (int frame = 0; frame < static_cast<int>(std::lround(seconds / kFrame)); ++frame) {
      sound.update(std::exchange(events, {}), lever, car, ears, knob, time);
      const std::vector<float> some = listen(world, kFrame);
      all.insert(all.end(), some.begin(), some.end());
      time += kFrame;
    }
    return all;
  }
};

inline std::vector<double> left(std::span<const float> stereo) {
  return channel(stereo, Ear::left);
}

// [1] The RMS level of both ears together.
inline double level(std::span<const float> stereo) {
  const std::vector<double> both = doubles(stereo);
  return rms(both);
}

}  // namespace gearshift::test
