// Films a lesson that a simulated driver drives, with a car that loads the lever.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/demo/film.h"
#include "app/lessons/simulated_driver/lesson_drive.h"

namespace gearshift::demo {

struct FilmedDrive {
  lessons::Lesson lesson;
  lessons::LessonResult result;
  std::vector<FilmFrame> film;
};

// Drives a lesson like drive_lesson() and films it. Replaces the callbacks on_cycle and on_event in the config.
FilmedDrive film_drive(lessons::LessonDriveConfig config);

// Returns the first shipped car that has every gear of the gate; empty if there is none.
std::optional<vehicle::CarSpec> fitting_car(const haptics::Gate& gate);

}  // namespace gearshift::demo
