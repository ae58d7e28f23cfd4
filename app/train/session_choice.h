// What a session is made of, by name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/devices/stick_lever.h"
#include "app/stage/drive_side.h"
#include "app/trainer/trainer.h"
#include "app/training/lesson_result.h"
#include "engine/sound/sound_world.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift {

inline constexpr std::string_view kByItself = "by itself";  // the hand that needs nobody
inline constexpr std::string_view kNoCar = "none";          // nothing behind the lever
inline constexpr std::string_view kNoLesson = "none";
inline constexpr std::string_view kSimulatedDevice = "simulated";

struct SessionChoice {
  std::string car;                    // shipped, a file, or kNoCar; empty: the lesson's, else "hatchback"
  std::string gate;                   // shipped, or a file; empty: the lesson's, else the car's, without a car "paper"
  std::string preset = "default";     // shipped, the user's own, or a file
  std::string hand;                   // light, grip, arm, M,B,K or kByItself; empty: the preset's, or a grip
  std::shared_ptr<StickLever> stick;  // that a person holds; none: the simulated lever
  std::string camera = "driver";      // the cabin is laid open for what is looked at
  DriveSide drive = DriveSide::left;  // where the driver sits
  TrainerClock clock = TrainerClock::real_time;
  SoundOutput sound = SoundOutput::card;
  std::uint64_t seed = 1;               // of the car's chance, and of the hand that needs nobody
  std::optional<HapticConfig> haptics;  // in place of the preset's

  std::string lesson;              // shipped, a file, or kNoLesson; empty: the one that is suggested
  std::optional<LessonMode> mode;  // none: as the coach thinks
  bool help = true;                // guidance as needed; else no trial is guided
  std::string learner;             // empty: nobody, nothing is remembered; nor of a hand by itself
  std::filesystem::path history;   // where it is remembered; empty: nowhere
  std::string no_history;          // and why not, where the person is to be told
};

// Who learns: what a hand shows by itself is nobody's.
inline std::string learner_of(const SessionChoice& choice) {
  return choice.hand == kByItself ? std::string{} : choice.learner;
}

}  // namespace gearshift
