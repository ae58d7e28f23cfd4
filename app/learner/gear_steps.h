// Steps of a drive through the gears, with speeds that suit the car: what drives without a lesson file are made of.
#pragma once

#include <vector>

#include "app/training/lesson.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift {

// Forward gears that both have, rising.
std::vector<int> forward_gears(const CarSpec& car, const Gate& gate);

// Engine speed [rad/s] at which to leave `low` for `high`, the next of forward_gears(): in the middle of the car's band,
// or later where `high` would labour.
double upshift_speed(const CarSpec& car, int low, int high) noexcept;
// Road speed [m/s] at which to go down to `low`: where it turns a little below the band.
double downshift_speed(const CarSpec& car, int low) noexcept;

LessonStep stand_step();  // to a stand, clutch down
LessonStep gear_step(int gear);
// Clutch down, lever to `to`, clutch up.
void add_shift(std::vector<LessonStep>& steps, int to);
// From a stand with the clutch down: first, and up to the last of `gears`.
void add_way_up(std::vector<LessonStep>& steps, const CarSpec& car, const std::vector<int>& gears);

// From where the car is to where a lesson begins: to a stand, then to its gear and speed. `from`: the car's.
Lesson approach_lesson(const Lesson& lesson, const CarSpec& car, const Gate& gate, const LessonStart& from);
// To a stand, and that is all; for a driver who has no lesson any more.
Lesson rest_lesson(const LessonStart& from);

}  // namespace gearshift
