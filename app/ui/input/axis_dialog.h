// Assigns axes of sticks, pads and pedals to clutch, brake, throttle and lever: the user moves these controls one after
// the other. Uses GLFW, so devices without force feedback work too.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/ui/input/bindings.h"

namespace gearshift::ui {

struct AxisDialog {
  std::function<void(const std::string& line)> print;
  // Asks the question and returns the line that the user enters; calls `frame` repeatedly while waiting for it. Throws
  // CalibrationEnded.
  std::function<std::string(const std::string& question, const std::function<void()>& frame)> ask;
  // Waits some milliseconds, then returns the state of all plugged-in devices.
  std::function<std::vector<engine::PadState>()> next_frame;
};

// Returns the bindings with the axes that the user has moved; the axis of a skipped control is unchanged. Exceptions
// from `dialog` pass through.
Bindings learn_axes(Bindings bindings, const AxisDialog& dialog);

// Returns the bindings to start from: those in `file`; if it does not exist or `again` is true, those in `defaults`
// without their axes. Throws FileError.
Bindings starting_bindings(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again);

// Implements `devices --calibrate` for devices without force feedback. `file` is only replaced at the end. answers: the
// file descriptor from which the user's answers are read. Returns the exit code. Throws FileError or
// std::runtime_error with one sentence.
int calibrate_pads(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again, int answers);

}  // namespace gearshift::ui
