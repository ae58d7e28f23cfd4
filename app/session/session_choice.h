// The user's choices for a session, by name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/cabin/stage/drive_side.h"
#include "app/lessons/assessment/lesson_result.h"
#include "app/runtime/devices/stick_lever.h"
#include "app/runtime/runtime.h"
#include "engine/sound/sound_world.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::session {

inline constexpr std::string_view kAutomaticHand = "by itself";  // the hand that the simulated driver leads
inline constexpr std::string_view kNoCar = "none";               // no car behind the lever
inline constexpr std::string_view kNoLesson = "none";
inline constexpr std::string_view kSimulatedDevice = "simulated";

struct SessionChoice {
  std::string car;                             // shipped, a file, or kNoCar; empty: the lesson's, else "hatchback"
  std::string gate;                            // shipped, or a file; empty: the lesson's, else the car's, else "paper"
  std::string preset = "default";              // shipped, the user's own, or a file
  std::string hand;                            // light, grip, arm, "M,B,K" or kAutomaticHand; empty: the preset's
  std::shared_ptr<runtime::StickLever> stick;  // the real stick; null: the simulated lever
  std::string camera = "driver";               // also decides which parts of the cabin are hidden
  cabin::DriveSide drive = cabin::DriveSide::left;  // where the driver sits
  runtime::RuntimeClock clock = runtime::RuntimeClock::real_time;
  engine::SoundOutput sound = engine::SoundOutput::card;
  std::uint64_t seed = 1;                        // for random effects of the car and for the simulated driver
  std::optional<haptics::HapticConfig> haptics;  // replaces the preset's

  std::string lesson;                       // shipped, a file, or kNoLesson; empty: the suggested one
  std::optional<lessons::LessonMode> mode;  // empty: the coach decides
  bool help = true;                         // false: no trial is guided
  std::string learner;                      // empty: results are not saved; nor are those of kAutomaticHand
  std::filesystem::path history;            // database file; empty: nothing is saved
  std::string no_history;                   // why nothing is saved, if the user should be told
};

// The learner whose results are saved. A drive by kAutomaticHand belongs to no learner.
inline std::string learner_of(const SessionChoice& choice) {
  return choice.hand == kAutomaticHand ? std::string{} : choice.learner;
}

}  // namespace gearshift::session
