// Lesson steps for driving through the gears, for drives without a lesson file. The speeds are computed from the car's
// data.
#pragma once

#include <vector>

#include "app/lessons/assessment/lesson.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Forward gears that both car and gate have, in ascending order.
std::vector<int> forward_gears(const vehicle::CarSpec& car, const haptics::Gate& gate);

// Engine speed [rad/s] for the shift from `low` to `high`, the next gear in forward_gears(): EngineSpec::shift_low, or
// more if the engine would labour in `high`, but at most 85 % of the red line.
double upshift_speed(const vehicle::CarSpec& car, int low, int high) noexcept;
// Road speed [m/s] for the downshift to `low`. In `low`, the engine then turns at 85 % of EngineSpec::shift_low.
double downshift_speed(const vehicle::CarSpec& car, int low) noexcept;

LessonStep stop_step();  // step that stops the car with the clutch down
LessonStep gear_step(int gear);
// Adds the steps of a shift: clutch down, lever to `to`, clutch up.
void add_shift(std::vector<LessonStep>& steps, int to);
// Adds the steps that lead through all `gears` in order. The car is at a stop with the clutch down before them.
void add_upshifts(std::vector<LessonStep>& steps, const vehicle::CarSpec& car, const std::vector<int>& gears);

// Returns a drive from the car's state `from` to the start of `lesson`. The car first stops, then reaches the gear and
// speed at which `lesson` starts.
Lesson approach_lesson(const Lesson& lesson, const vehicle::CarSpec& car, const haptics::Gate& gate,
                       const LessonStart& from);
// Returns a lesson that only stops the car, for a driver whose lesson is over.
Lesson rest_lesson(const LessonStart& from);

}  // namespace gearshift::lessons
