// The shipped lessons as a simulated learner drives them.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "app/learner/lesson_drive.h"

namespace gearshift {

// In the car and the gate that the lesson names, or else the hatchback and its own.
inline LessonDriveConfig shipped_drive(std::string_view key, std::uint64_t seed = 1) {
  LessonDriveConfig config;
  config.lesson = read_lesson(GEARSHIFT_ASSETS "/lessons/" + std::string(key) + ".toml");
  const std::string car = config.lesson.car.empty() ? "hatchback" : config.lesson.car;
  config.car = read_car(GEARSHIFT_ASSETS "/cars/" + car + ".toml");
  const std::string gate = config.lesson.gate.empty() ? config.car.gate : config.lesson.gate;
  config.gate = read_gate_layout(GEARSHIFT_ASSETS "/gates/" + gate + ".toml");
  config.seed = seed;
  return config;
}

// Named, and more than a note.
inline bool names(const LessonResult& result, FaultKind kind) {
  return std::any_of(result.faults.begin(), result.faults.end(),
                     [&](const DriveFault& fault) { return fault.kind == kind && fault.severity != Severity::note; });
}

inline std::string fault_list(const LessonResult& result) {
  std::string list;
  for (const DriveFault& fault : result.faults) {
    if (fault.severity != Severity::note) list += fault_sentence(fault) + " ";
  }
  return list;
}

}  // namespace gearshift
