// Plays the engine's loops, mixed by engine speed and load.
#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "app/cabin/sound/engine_synth.h"
#include "engine/sound/sound_world.h"

namespace gearshift::cabin {

class EngineVoices {
 public:
  EngineVoices(engine::SoundWorld& world, int cylinders);

  // speed [1/min], load 0 to 1, gain 0 to 1. Silent at speed 0; the pitch follows the speed between 600 and 9600 1/min.
  void set(engine::SoundWorld& world, double speed, double load, double gain, glm::vec3 position) const;

 private:
  std::array<std::array<engine::VoiceId, 2>, kEngineBands.size()> voices_{};  // for each band: coasting, full load
};

}  // namespace gearshift::cabin
