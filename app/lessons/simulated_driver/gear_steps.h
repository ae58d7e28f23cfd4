// Lesson steps for driving through the gears, with speeds that suit the car: for drives without a lesson file.
#pragma once

#include <vector>

#include "app/lessons/assessment/lesson.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Forward gears that both car and gate have, in ascending order.
std::vector<int> forward_gears(const vehicle::CarSpec& car, const haptics::Gate& gate);

// Engine speed [rad/s] at which to shift from `low` to `high`, the next of forward_gears(): within the car's band, or
// later if the engine would labour in `high`.
double upshift_speed(const vehicle::CarSpec& car, int low, int high) noexcept;
// Road speed [m/s] at which to shift down to `low`: the engine then turns slightly below the band.
double downshift_speed(const vehicle::CarSpec& car, int low) noexcept;

LessonStep stop_step();  // brings the car to a stop, clutch down
LessonStep gear_step(int gear);
// Adds the steps of a shift: clutch down, lever to `to`, clutch up.
void add_shift(std::vector<LessonStep>& steps, int to);
// Adds the steps that lead from a stop with the clutch down through all `gears`, in order.
void add_upshifts(std::vector<LessonStep>& steps, const vehicle::CarSpec& car, const std::vector<int>& gears);

// A drive from the car's state `from` to the start of `lesson`: to a stop, then to the lesson's gear and speed.
Lesson approach_lesson(const Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate,
                       const LessonStart& from);
// A lesson that only stops the car, for a driver whose lesson is over.
Lesson rest_lesson(const LessonStart& from);

}  // namespace gearshift::lessons
