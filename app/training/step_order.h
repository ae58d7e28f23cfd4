// The order in which lever and pedals are taught, and how far a shift was from it.
#pragma once

#include <span>
#include <vector>

#include "app/training/drive_fault.h"
#include "app/training/shift_record.h"

namespace gearshift {

// Off the throttle, clutch down, neutral, gear, clutch up, throttle. Out of neutral there is no neutral to go to, into
// neutral no gear.
std::vector<ShiftStep> taught_steps(int from, int to);

// Least number of steps to add, leave out or replace that makes `steps` one of the orders that are taught (Levenshtein
// distance): 2 for two that were exchanged. Taught are: the plain one above; between two gears double declutching, up and
// down again in neutral; and into a lower gear either of them with a blip, the throttle on anywhere between the first
// clutch down and the last clutch up, and off again there or after it, or held on into the drive. Whether the throttle
// was taken up again before the shift ended does not count. whole: false where the shift was cut short, and what was
// still to come does not count.
int steps_out_of_place(std::span<const ShiftStep> steps, int from, int to, bool whole = true);

// Of a shift that is out of order: what of it comes first in the plain order, in words that a driver knows. other: it
// is in that order, or something else.
StepSlip first_slip(std::span<const ShiftStep> steps, int from, int to);

}  // namespace gearshift
