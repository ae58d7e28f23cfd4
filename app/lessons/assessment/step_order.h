// The step orders that lessons teach for a shift, and how far a driven shift deviated from them.
#pragma once

#include <span>
#include <vector>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/shift_record.h"

namespace gearshift::lessons {

// The plain order: off the throttle, clutch down, neutral, gear, clutch up, throttle. A shift from neutral has no
// neutral step; a shift into neutral has no gear step.
std::vector<ShiftStep> taught_steps(int from, int to);

// Smallest number of steps to insert, remove or replace to turn `steps` into a taught order (Levenshtein distance);
// swapping two steps costs 2. Every shift may use the plain order. A shift between two gears may also use double
// declutching: clutch up and down again in neutral. In a downshift, both orders may contain a blip, which starts
// between the first clutch down and the last clutch up, and ends by the last clutch up, right after it, or only in the
// drive after the shift. Whether the throttle was back on before the shift ended does not matter. `is_complete`: false
// if the shift was cut short. Steps missing at its end then do not count.
int steps_out_of_place(std::span<const ShiftStep> steps, int from, int to, bool is_complete = true);

// Returns the first mistake relative to the plain order. Returns `other` if there is no mistake, or if OrderMistake has
// no value for it.
OrderMistake first_order_mistake(std::span<const ShiftStep> steps, int from, int to);

}  // namespace gearshift::lessons
