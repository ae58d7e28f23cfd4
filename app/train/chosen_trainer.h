// From a choice to the lever that runs.
#pragma once

#include "app/train/chosen.h"
#include "app/training/lesson.h"

namespace gearshift {

// As the lesson begins; null: none, the car stands. A hand by itself drives the lesson, or, without one, up and down
// through the gears, lap after lap. Throws FileError or std::invalid_argument with one sentence.
TrainerConfig chosen_trainer(const SessionChoice& choice, const ChosenCar& chosen, const Lesson* lesson);

}  // namespace gearshift
