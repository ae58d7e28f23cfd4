// The driveline's sounds, playing: starter, stall, limiter, grinding dogs.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "app/cabin_sound/warning_hold.h"
#include "app/vehicle/vehicle_state.h"
#include "engine/sound/sound_world.h"

namespace gearshift {

// Teeth pass each other so often, |difference| [rad/s] * teeth / (2 pi). [Hz]
double tooth_pass_rate(double difference, double teeth) noexcept;
// 0 to 1: of dogs that rattle with so much power [W]: with its root, never so soft that nobody hears it.
double grind_gain(double power) noexcept;

// A loop that plays from now on, and is not heard before its gain is set.
VoiceId silent_loop(SoundWorld& world, const std::vector<float>& samples);

class CarVoices {
 public:
  explicit CarVoices(SoundWorld& world);

  struct Place {
    glm::vec3 engine{0.0f}, knob{0.0f}, cluster{0.0f};  // [m] world
  };
  // Each frame. engine: its starter, judder and limiter are wanted. teeth: of the dogs. time [s].
  void set(SoundWorld& world, const VehicleState& car, bool engine, double teeth, const Place& at, double time);

 private:
  void sound_engine(SoundWorld& world, const VehicleState& car, bool engine, glm::vec3 place, double time);
  void announce_stall(SoundWorld& world, const VehicleState& car, glm::vec3 place);

  VoiceId grind_, starter_, judder_, limiter_;
  ClipId chime_;
  WarningHold cut_;      // fuel comes and goes with the limiter's band: one stutter
  bool stalled_ = true;  // in the frame before
};

}  // namespace gearshift
