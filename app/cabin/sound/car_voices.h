// Plays the driveline's sounds: starter, judder, stall, limiter, grinding dogs.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "app/cabin/sound/warning_hold.h"
#include "app/vehicle/vehicle_state.h"
#include "engine/sound/sound_world.h"

namespace gearshift::cabin {

// Rate [Hz] at which the teeth of two parts pass each other: |difference| * teeth / (2 pi). `difference`: difference of
// the two speeds [rad/s].
double tooth_pass_rate(double difference, double teeth) noexcept;
// Gain, 0 to 1, for the sound of dogs that rattle with this power [W]. The gain grows from an audible minimum with the
// square root of the power.
double grind_gain(double power) noexcept;

// Starts playing a loop with gain 0.
engine::VoiceId start_silent_loop(engine::SoundWorld& world, const std::vector<float>& samples);

class CarVoices {
 public:
  explicit CarVoices(engine::SoundWorld& world);

  struct Place {
    glm::vec3 engine{0.0f}, knob{0.0f}, cluster{0.0f};  // [m] world
  };
  // Call in each frame. `engine`: if true, starter, judder and limiter are played too. `teeth`: number of dog teeth.
  // `time`: [s].
  void set(engine::SoundWorld& world, const vehicle::VehicleState& car, bool engine, double teeth, const Place& at,
           double time);

  // A tick each time the clutch pedal, pressed or released, passes the bite point: help for the feet. 0: none.
  void set_bite_tick(double gain) noexcept { bite_tick_ = gain; }

 private:
  void play_bite_tick(engine::SoundWorld& world, const vehicle::VehicleState& car, glm::vec3 place);
  void update_engine(engine::SoundWorld& world, const vehicle::VehicleState& car, bool engine, glm::vec3 place,
                     double time);
  void play_stall_chime(engine::SoundWorld& world, const vehicle::VehicleState& car, glm::vec3 place);

  engine::VoiceId grind_, starter_, judder_, limiter_;
  engine::ClipId chime_, tick_;
  WarningHold cut_;            // joins the limiter's many short fuel cuts into one continuous stutter
  double bite_tick_ = 0.0;     // [1]
  bool is_above_bite_ = true;  // the clutch pedal was above the bite point in the last frame
  bool stalled_ = true;        // was stalled in the last frame; initially true: no chime at the start
};

}  // namespace gearshift::cabin
