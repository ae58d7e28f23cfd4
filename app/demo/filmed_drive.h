// A simulated learner's drive with a car behind the lever, filmed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/demo/film.h"
#include "app/learner/lesson_drive.h"

namespace gearshift {

struct FilmedDrive {
  Lesson lesson;
  LessonResult result;
  std::vector<FilmFrame> film;
};

// As drive_lesson(), whose watch and hear are taken.
FilmedDrive film_drive(LessonDriveConfig config);

// The first shipped car that has every gear of the gate.
std::optional<CarSpec> fitting_car(const Gate& gate);

}  // namespace gearshift
