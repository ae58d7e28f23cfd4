// How a person sits, kept from one day to the next.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/headset/seat.h"
#include "app/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift {

struct SeatSettings {
  DriveSide drive = DriveSide::left;  // where the driver sits
  double height = 0.0;                // [m] -0.3 to 0.3: the seat is raised by; not with a lever that stands somewhere
  std::optional<KnobDistance> knob;   // measured from the eyes; [m] each -1.5 to 1.5
  std::optional<EyePose> touched;     // the cabin from the room: the lever was touched there
  double touch_error = 0.0;           // [m] 0 to 0.1: the worst of the touches
};

// A file that is not there: nothing is set. Throws FileError.
SeatSettings read_seat(const std::filesystem::path& file);
void write_seat(const SeatSettings& seat, const std::filesystem::path& file);  // and its folder. Throws FileError

}  // namespace gearshift
