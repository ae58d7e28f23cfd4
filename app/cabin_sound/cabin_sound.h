// What the cabin sounds like: engine, starter, stall, grind, knocks, detents, warnings. All is made here, none is
// recorded.
#pragma once

#include <map>

#include <glm/vec3.hpp>

#include "app/cabin_sound/car_voices.h"
#include "app/cabin_sound/engine_voices.h"
#include "app/cabin_sound/warning_hold.h"
#include "app/vehicle/vehicle_state.h"
#include "engine/scene/view.h"
#include "engine/sound/sound_world.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

struct CabinSoundConfig {
  float volume = 0.7f;  // [1] 0 to 1
  bool engine = true;
  int cylinders = 4;            // 1 to 12, of a four-stroke engine: fires cylinders / 2 times a turn
  double dog_teeth = 36.0;      // [1] of the gearbox's dogs, > 0: how fast they rattle
  double loudest_impact = 0.5;  // [m/s] at which the knock is at full gain; below, gain is proportional to the speed
};

inline constexpr double kWarningLength = 0.3;  // [s] a warning is heard at least so long
inline constexpr double kSaturationHold =
    0.25;  // [s] saturation, or over-rev, that comes back within it is one warning

class CabinSound {
 public:
  // The world must outlive it.
  CabinSound(SoundWorld& world, const CabinSoundConfig& config);

  void hear(const HapticEvent& event, glm::vec3 knob);  // each event of the loop, once
  // Each frame, after the events: engine by speed and load, starter, judder, limiter, grind; a chime when it stalls;
  // warnings while push, saturation or over-rev last.
  // Ends with the world's update(time). World coordinates are the cabin's: metres, +X right, +Y up, -Z ahead.
  void update(const HapticSnapshot& lever, const VehicleState& car, const EyePose& ears, glm::vec3 knob, double time);
  void set_config(const CabinSoundConfig& config);
  const CabinSoundConfig& config() const noexcept { return config_; }

 private:
  struct Warning {
    VoiceId voice;
    WarningHold hold;
  };

  const EngineVoices& engine_voices();
  void listen(const EyePose& ears);
  void sound_engine(const VehicleState& car);
  void sound_warning(Warning& warning, bool lasts, Voice as, double time);

  SoundWorld& world_;
  CabinSoundConfig config_;
  ClipId knock_, gear_in_, gear_out_;
  CarVoices car_;
  Warning over_push_, saturation_, over_rev_;
  std::map<int, EngineVoices> engines_;  // by cylinders: a world keeps its clips, so each engine is made once
};

}  // namespace gearshift
