#include "app/cabin/sound/engine_voices.h"

#include <algorithm>

namespace gearshift::cabin {

namespace {

constexpr double kRunning = 500.0;  // [1/min] below this speed, the volume is proportional to the speed

}  // namespace

EngineVoices::EngineVoices(engine::SoundWorld& world, int cylinders) {
  for (std::size_t band = 0; band < kEngineBands.size(); ++band) {
    for (const EngineLoad load : {EngineLoad::coasting, EngineLoad::full}) {
      const engine::ClipId clip = world.add_clip(engine_loop(cylinders, band, load));
      voices_[band][static_cast<std::size_t>(load)] = world.loop(clip, {.gain = 0.0f});
    }
  }
}

void EngineVoices::set(engine::SoundWorld& world, double speed, double load, double gain, glm::vec3 position) const {
  const auto weights = band_weights(speed);
  const double throttle = std::clamp(load, 0.0, 1.0);
  const double running = gain * std::clamp(speed / kRunning, 0.0, 1.0);
  const auto pitch = static_cast<float>(speed / kEngineLoopSpeed);
  for (std::size_t band = 0; band < kEngineBands.size(); ++band) {
    const double level = running * weights[band];
    world.set(voices_[band][0], {position, static_cast<float>(level * (1.0 - throttle)), pitch});
    world.set(voices_[band][1], {position, static_cast<float>(level * throttle), pitch});
  }
}

}  // namespace gearshift::cabin
