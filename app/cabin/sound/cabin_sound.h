// The sounds of the cabin: engine and driveline, knocks, gear clicks, warnings. All sounds are synthesised.
#pragma once

#include <map>
#include <span>

#include <glm/vec3.hpp>

#include "app/cabin/sound/car_voices.h"
#include "app/cabin/sound/engine_voices.h"
#include "app/cabin/sound/warning_hold.h"
#include "app/vehicle/vehicle_state.h"
#include "engine/scene/view.h"
#include "engine/sound/sound_world.h"
#include "haptics/loop/haptic_event.h"

namespace gearshift::cabin {

struct CabinSoundConfig {
  float volume = 0.68f;  // [1] 0 to 1; all sounds together then stay within full scale, also with OpenAL Soft 1.24
  bool engine = true;
  int cylinders = 4;            // 1 to 12; the four-stroke engine fires cylinders / 2 times per revolution
  double dog_teeth = 36.0;      // [1] > 0; number of dog teeth; determines the pitch of the grind
  double loudest_impact = 0.5;  // [m/s] impact speed at which the knock has full gain; proportional below
};

inline constexpr double kWarningLength = 0.3;  // [s] minimum duration of a warning
// [s] If saturation or over-rev returns within this time, the same warning continues.
inline constexpr double kSaturationHold = 0.25;

class CabinSound {
 public:
  // The world must outlive this object.
  CabinSound(engine::SoundWorld& world, const CabinSoundConfig& config);

  // Plays a frame. `events`: the loop's events since the last frame. Updates the sounds of engine (by speed and load),
  // starter, judder, limiter and grind; plays a chime when the engine stalls; sounds warnings as long as over-push,
  // saturation or over-rev lasts. Calls the world's update(time) at the end. Cabin coordinates: metres, +X right, +Y up,
  // -Z ahead.
  void update(std::span<const haptics::HapticEvent> events, const haptics::HapticSnapshot& lever,
              const vehicle::VehicleState& car, const engine::EyePose& ears, glm::vec3 knob, double time);
  void set_bite_tick(double gain) { car_.set_bite_tick(gain); }  // [1] 0 to 1, see CarVoices
  void set_config(const CabinSoundConfig& config);
  const CabinSoundConfig& config() const noexcept { return config_; }

 private:
  struct Warning {
    engine::VoiceId voice;
    WarningHold hold;
  };

  void on_event(const haptics::HapticEvent& event, glm::vec3 knob);
  const EngineVoices& engine_voices();
  void update_listener(const engine::EyePose& ears);
  void update_engine(const vehicle::VehicleState& car, double time);
  void update_warning(Warning& warning, bool lasts, engine::Voice as, double time);

  engine::SoundWorld& world_;
  CabinSoundConfig config_;
  engine::ClipId knock_, gear_in_, gear_out_;
  CarVoices car_;
  Warning over_push_, saturation_, over_rev_;
  // Engine sounds by number of cylinders. A SoundWorld never frees its clips, so each engine is synthesised only once.
  std::map<int, EngineVoices> engines_;
  double load_ = 0.0;        // [1] the engine's load as it is heard
  double updated_at_ = 0.0;  // [s] time of the last update
};

}  // namespace gearshift::cabin
