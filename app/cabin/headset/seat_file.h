// Reads and writes the seat calibration, which is saved between sessions.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "app/cabin/headset/seat.h"
#include "app/cabin/stage/drive_side.h"
#include "engine/scene/view.h"

namespace gearshift::cabin {

struct SeatSettings {
  DriveSide drive = DriveSide::left;       // the driver's side
  double height = 0.0;                     // [m] -0.3 to 0.3: raises the seat; unused if the lever's position is known
  std::optional<KnobDistance> knob;        // [m] distances from the eyes, each -1.5 to 1.5
  std::optional<engine::EyePose> touched;  // pose of the room in the cabin, from touching the lever
  double touch_error = 0.0;                // [m] 0 to 0.1: error of `touched`
};

// Returns default settings if the file does not exist. Throws FileError.
SeatSettings read_seat(const std::filesystem::path& file);
SeatSettings parse_seat(std::string_view text, const std::string& file_name);
// Creates the file's folder if it is missing. Throws FileError.
void write_seat(const SeatSettings& seat, const std::filesystem::path& file);
std::string seat_text(const SeatSettings& seat);

}  // namespace gearshift::cabin
