// A shipped lesson with the car and the gate that it is driven with.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/learner/lesson_drive.h"

namespace gearshift {

inline LessonDriveConfig shipped_drive(const std::filesystem::path& assets, std::string_view key) {
  LessonDriveConfig config;
  config.lesson = read_lesson(assets / "lessons" / (std::string(key) + ".toml"));
  const std::string car = config.lesson.car.empty() ? "hatchback" : config.lesson.car;
  config.car = read_car(assets / "cars" / (car + ".toml"));
  const std::string gate = config.lesson.gate.empty() ? config.car.gate : config.lesson.gate;
  config.gate = read_gate_layout(assets / "gates" / (gate + ".toml"));
  return config;
}

}  // namespace gearshift
