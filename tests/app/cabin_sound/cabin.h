// A driver in a cabin that makes sounds, rendered to memory.
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "app/cabin_sound/cabin_sound.h"
#include "tests/engine/sound/measure.h"

namespace gearshift {

inline constexpr glm::vec3 kKnob{0.37f, 0.35f, -0.25f};
inline constexpr double kFrame = 1.0 / 60.0;

inline VehicleState running(double speed, double load) {  // [1/min]
  VehicleState car;
  car.engine_speed = speed * std::numbers::pi / 30.0;
  car.engine_load = load;
  return car;
}

// A driver in a cabin that makes sounds.
struct Cabin {
  SoundWorld world{SoundOutput::memory};
  CabinSound sound;
  HapticSnapshot lever;
  VehicleState car;
  EyePose ears = look_at({0.0, 0.65, 0.0}, {0.0, 0.65, -1.0});
  glm::vec3 knob = kKnob;
  double time = 0.0;

  explicit Cabin(const CabinSoundConfig& config = {}) : sound(world, config) {}

  void hear(EventKind kind, double value = 0.0) { sound.hear({kind, 0, 0, value}, knob); }

  std::vector<float> run(double seconds) {
    std::vector<float> all;
    for (int frame = 0; frame < static_cast<int>(std::lround(seconds / kFrame)); ++frame) {
      sound.update(lever, car, ears, knob, time);
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

// Of both ears. [1] RMS
inline double level(std::span<const float> stereo) {
  const std::vector<double> both = doubles(stereo);
  return rms(both);
}

}  // namespace gearshift
