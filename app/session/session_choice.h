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

inline constexpr std::string_view kAutomaticHand = "by itself";  // the hand that a simulated driver moves
inline constexpr std::string_view kNoCar = "none";               // no car loads the lever
inline constexpr std::string_view kNoLesson = "none";
inline constexpr std::string_view kSimulatedDevice = "simulated";

struct SessionChoice {
  std::string car;   // name of a shipped car, path, or kNoCar; empty: the lesson's car, else "hatchback"
  std::string gate;  // name of a shipped gate, or path; empty: the lesson's gate, else the car's, else "paper"
  std::string preset = "default";  // name of a shipped preset or one of the user's own, or path
  // Simulated hand: "light", "grip", "arm", "M,B,K" (the numbers mass [kg], damping [N s/m], stiffness [N/m]) or
  // kAutomaticHand. Empty: the preset's hand.
  std::string hand;
  std::shared_ptr<runtime::StickLever> stick;       // the real stick; null: the simulated lever
  std::shared_ptr<runtime::ControlsWatch> watch;    // of every lever of the session; null: none
  std::string camera = "driver";                    // name of the first camera, see cabin_for_camera()
  cabin::DriveSide drive = cabin::DriveSide::left;  // side on which the driver sits
  runtime::RuntimeClock clock = runtime::RuntimeClock::real_time;
  engine::SoundOutput sound = engine::SoundOutput::card;
  vehicle::PedalTiming pedal_timing;             // of the pedals that keys press
  std::uint64_t seed = 1;                        // random seed of the car and of the simulated driver
  std::optional<haptics::HapticConfig> haptics;  // if not empty, replaces the preset's configuration

  std::string lesson;                       // name of a shipped lesson, path, or kNoLesson; empty: the suggested one
  std::optional<lessons::LessonMode> mode;  // empty: the coach decides
  bool help = true;                         // false: the lever never guides the hand
  std::string learner;                      // if empty, or if the hand is kAutomaticHand, results are not saved
  std::filesystem::path history;            // database file; empty: no results are saved
  std::string server;                       // address of the school's server; empty: none
  std::string no_history;                   // tells the user why `history` is empty; may be empty
};

// Returns the learner whose results are saved. A drive by kAutomaticHand belongs to no learner.
inline std::string learner_of(const SessionChoice& choice) {
  return choice.hand == kAutomaticHand ? std::string{} : choice.learner;
}

}  // namespace gearshift::session
