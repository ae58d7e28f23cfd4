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
  std::string car;   // name of a shipped car, path, or kNoCar; empty: the lesson's car, else "hatchback"
  std::string gate;  // name of a shipped gate, or path; empty: the lesson's gate, else the car's, else "paper"
  std::string preset = "default";              // name of a shipped preset or of one of the user's own, or path
  std::string hand;                            // light, grip, arm, "M,B,K" or kAutomaticHand; empty: the preset's hand
  std::shared_ptr<runtime::StickLever> stick;  // the real stick; null: the simulated lever
  std::string camera = "driver";               // name of the first camera, see cabin_for_camera()
  cabin::DriveSide drive = cabin::DriveSide::left;  // side on which the driver sits
  runtime::RuntimeClock clock = runtime::RuntimeClock::real_time;
  engine::SoundOutput sound = engine::SoundOutput::card;
  std::uint64_t seed = 1;                        // random seed of the car and of the simulated driver
  std::optional<haptics::HapticConfig> haptics;  // replaces the preset's configuration if not empty

  std::string lesson;                       // name of a shipped lesson, path, or kNoLesson; empty: the suggested one
  std::optional<lessons::LessonMode> mode;  // empty: the coach decides
  bool help = true;                         // false: the lever guides the hand in no trial
  std::string learner;                      // empty: results are not saved; with kAutomaticHand they never are
  std::filesystem::path history;            // database file; empty: nothing is saved
  std::string no_history;                   // reason for an empty `history` that the user should know; may be empty
};

// The learner whose results are saved. A drive by kAutomaticHand belongs to no learner.
inline std::string learner_of(const SessionChoice& choice) {
  return choice.hand == kAutomaticHand ? std::string{} : choice.learner;
}

}  // namespace gearshift::session
