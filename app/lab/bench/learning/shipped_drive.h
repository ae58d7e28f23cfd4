// Loads a shipped lesson with its car and gate.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::lab {

inline lessons::LessonDriveConfig shipped_drive(const std::filesystem::path& assets, std::string_view key) {
  lessons::LessonDriveConfig config;
  config.lesson = lessons::read_lesson(assets / "lessons" / (std::string(key) + ".toml"));
  const std::string car = config.lesson.car.empty() ? "hatchback" : config.lesson.car;
  config.car = vehicle::read_car(assets / "cars" / (car + ".toml"));
  const std::string gate = config.lesson.gate.empty() ? config.car.gate : config.lesson.gate;
  config.gate = haptics::read_gate_layout(assets / "gates" / (gate + ".toml"));
  return config;
}

}  // namespace gearshift::lab
