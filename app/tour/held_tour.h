// The tour by whoever holds a stick: each gear to be shifted to is told, and forces come after Enter alone.
#pragma once

#include <functional>
#include <string>

#include "app/devices/answers.h"
#include "app/devices/stick_lever.h"
#include "app/tour/tour.h"

namespace gearshift {

// A line for who holds the stick.
using TourWords = std::function<void(const std::string& line)>;

// Drives on the real clock and records, as drive_tour() does, until every gear of the order came, others between or not,
// that many seconds are over, or the program is asked to end. A stick that is unplugged is waited for meanwhile. The
// setup's gate is made for the stick; its hand and its seed are not used. Throws FileError, std::invalid_argument or
// std::runtime_error with one sentence; what was recorded is kept.
TourResult drive_held_tour(TourSetup& setup, StickLever& stick, double seconds, Answers& answers, const TourWords& say,
                           const TourProgress& progress);

}  // namespace gearshift
