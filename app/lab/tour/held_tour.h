// The tour driven by the user with a stick: prompts for each gear, and switches forces on only after Enter.
#pragma once

#include <functional>
#include <string>

#include "app/base/line_reader.h"
#include "app/lab/tour/tour.h"
#include "app/runtime/devices/stick_lever.h"

namespace gearshift::lab {

// Prints a line for the user at the stick.
using TourOutput = std::function<void(const std::string& line)>;

// Runs in real time and records like drive_tour() until every gear was engaged in order (other gears in between are
// allowed), `seconds` have passed, or the program is asked to end. If the stick is unplugged, waits for it to return.
// Compiles setup.gate for the stick; the setup's hand and seed are not used. Throws FileError, std::invalid_argument or
// std::runtime_error with one sentence; the recording is kept.
TourResult drive_held_tour(TourSetup& setup, runtime::StickLever& stick, double seconds, base::LineReader& answers,
                           const TourOutput& output, const TourProgress& progress);

}  // namespace gearshift::lab
