// The shipped lessons, set up for a simulated driver.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::test {

// Uses the car and the gate that the lesson names. If the lesson names none, uses the hatchback and its gate.
inline lessons::LessonDriveConfig shipped_drive(std::string_view key, std::uint64_t seed = 1) {
  lessons::LessonDriveConfig config;
  config.lesson = lessons::read_lesson(GEARSHIFT_ASSETS "/lessons/" + std::string(key) + ".toml");
  const std::string car = config.lesson.car.empty() ? "hatchback" : config.lesson.car;
  config.car = vehicle::read_car(GEARSHIFT_ASSETS "/cars/" + car + ".toml");
  const std::string gate = config.lesson.gate.empty() ? config.car.gate : config.lesson.gate;
  config.gate = haptics::read_gate_layout(GEARSHIFT_ASSETS "/gates/" + gate + ".toml");
  config.seed = seed;
  return config;
}

// Whether the result contains an error of this kind that is worse than a note.
inline bool names(const lessons::LessonResult& result, lessons::ErrorKind kind) {
  return std::any_of(result.errors.begin(), result.errors.end(), [&](const lessons::DrivingError& error) {
    return error.kind == kind && error.severity != lessons::Severity::note;
  });
}

inline std::string error_list(const lessons::LessonResult& result) {
  std::string list;
  for (const lessons::DrivingError& error : result.errors) {
    if (error.severity != lessons::Severity::note) list += lessons::error_sentence(error) + " ";
  }
  return list;
}

}  // namespace gearshift::test
