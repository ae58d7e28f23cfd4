// The orders of a shift's steps that the lessons teach, and how far a shift deviated from them.
#pragma once

#include <span>
#include <vector>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/shift_record.h"

namespace gearshift::lessons {

// The plain order: off the throttle, clutch down, neutral, gear, clutch up, throttle. A shift from neutral has no
// neutral step; a shift into neutral has no gear step.
std::vector<ShiftStep> taught_steps(int from, int to);

// Smallest number of steps to insert, remove or replace that turns `steps` into one of the orders taught (Levenshtein
// distance); swapping two steps costs 2. The orders taught are: the plain order; between two gears also double
// declutching (clutch up and down again in neutral); into a lower gear also both of these with a blip. A blip starts
// anywhere between the first clutch down and the last clutch up. It ends in the same range or right after it, or is
// held into the drive. Whether the throttle was back on before the shift ended does not matter. is_complete: false if
// the shift was cut short; missing steps at its end then do not count.
int steps_out_of_place(std::span<const ShiftStep> steps, int from, int to, bool is_complete = true);

// The first mistake compared with the plain order. Returns `other` if the order is right, or if OrderMistake has no
// value for the deviation.
OrderMistake first_order_mistake(std::span<const ShiftStep> steps, int from, int to);

}  // namespace gearshift::lessons
