// The tour (one shift into every gear), driven by the user with a stick. Prompts for each gear. Forces go on only after
// the user has pressed Enter.
#pragma once

#include <functional>
#include <string>

#include "app/base/line_reader.h"
#include "app/lab/tour/tour.h"
#include "app/runtime/devices/stick_lever.h"

namespace gearshift::lab {

// Prints a line for the user who holds the stick.
using TourOutput = std::function<void(const std::string& line)>;

// Runs in real time and records like drive_tour(). Ends when every gear was engaged in order, when `seconds` have
// passed, or when the program is asked to end. Other gears may be engaged in between. If the stick is unplugged, waits
// until it is connected again. Compiles `setup.gate` for the stick; ignores the hand and the seed in `setup`. Throws
// FileError, std::invalid_argument or std::runtime_error with one sentence; the recording is not deleted.
TourResult drive_held_tour(TourSetup& setup, runtime::StickLever& stick, double seconds, base::LineReader& answers,
                           const TourOutput& output, const TourProgress& progress);

}  // namespace gearshift::lab
