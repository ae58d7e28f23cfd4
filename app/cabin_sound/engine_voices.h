// The engine's loops, playing: mixed by speed and load.
#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "app/cabin_sound/engine_synth.h"
#include "engine/sound/sound_world.h"

namespace gearshift {

class EngineVoices {
 public:
  EngineVoices(SoundWorld& world, int cylinders);

  // speed [1/min], load 0 to 1, gain 0 to 1. At rest it is silent; from 600 to 9600 / min the pitch follows the speed.
  void set(SoundWorld& world, double speed, double load, double gain, glm::vec3 position) const;

 private:
  std::array<std::array<VoiceId, 2>, kEngineBands.size()> voices_{};  // by band: coasting, full
};

}  // namespace gearshift
