// Assigns axes of sticks, pads and pedals to clutch, brake, throttle and lever by asking the user to move these
// controls one after the other. Uses GLFW, so devices without force feedback work too.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/ui/input/bindings.h"

namespace gearshift::ui {

struct AxisDialog {
  std::function<void(const std::string& line)> print;
  // Asks the question and returns the line that the user enters; calls `frame` repeatedly while waiting for the line.
  // Throws CalibrationEnded.
  std::function<std::string(const std::string& question, const std::function<void()>& frame)> ask;
  // Waits some milliseconds, then returns the state of all plugged-in devices.
  std::function<std::vector<engine::PadState>()> next_frame;
};

// Returns the bindings with the axes that the user has moved. If the user skips a control, its axis is unchanged.
// Exceptions thrown by `dialog` reach the caller.
Bindings learn_axes(Bindings bindings, const AxisDialog& dialog);

// Returns the bindings to start from: those in `file`. If `file` does not exist or `again` is true, returns those in
// `defaults`, but without axes. Throws FileError.
Bindings starting_bindings(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again);

// Implements `devices --calibrate` for devices without force feedback. `file` is replaced only at the end. `answers`:
// the file descriptor from which the user's answers are read. Returns the exit code. Throws FileError, or
// std::runtime_error with one sentence.
int calibrate_pads(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again, int answers);

}  // namespace gearshift::ui
