// The order of steps that is taught for a shift, and how far a shift deviated from it.
#pragma once

#include <span>
#include <vector>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/shift_record.h"

namespace gearshift::lessons {

// Off the throttle, clutch down, neutral, gear, clutch up, throttle. Starting from neutral there is no neutral step;
// ending in neutral there is no gear step.
std::vector<ShiftStep> taught_steps(int from, int to);

// Smallest number of steps to insert, remove or replace that turns `steps` into one of the orders taught (Levenshtein
// distance); swapping two steps costs 2. The orders taught are: the plain one above; between two gears also double
// declutching, clutch up and down again in neutral; into a lower gear either of them with a blip. A blip starts
// anywhere between the first clutch down and the last clutch up, and ends there, after it, or is held into the drive.
// Whether the throttle was back on before the shift ended does not matter. is_complete: false if the shift was cut
// short; missing steps at its end do not count then.
int steps_out_of_place(std::span<const ShiftStep> steps, int from, int to, bool is_complete = true);

// The first thing out of order, compared with the plain order. other: the order is right, or the deviation is something
// else.
OrderMistake first_order_mistake(std::span<const ShiftStep> steps, int from, int to);

}  // namespace gearshift::lessons
