// Assigns axes of sticks, pads and pedals to clutch, brake, throttle and lever: the user moves one after another. Works
// without force feedback, through GLFW.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/ui/input/bindings.h"

namespace gearshift::ui {

struct AxisDialog {
  std::function<void(const std::string& line)> print;
  // Returns the line that answers the question; calls `frame` some hundred times per second while waiting. Throws
  // CalibrationEnded.
  std::function<std::string(const std::string& question, const std::function<void()>& frame)> ask;
  std::function<std::vector<engine::PadState>()>
      next_frame;  // state of the plugged-in devices, after some milliseconds
};

// Returns the bindings with the axes that the user has moved; a skipped axis is unchanged. Throws whatever `dialog`
// throws.
Bindings learn_axes(Bindings bindings, const AxisDialog& dialog);

// The bindings to start from: those in `file`, or, if there are none or with `again`, `defaults` without axes. Throws
// FileError.
Bindings starting_bindings(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again);

// `devices --calibrate` for these devices. The file is only replaced at the end. answers: a file descriptor. Returns
// the exit code. Throws FileError or std::runtime_error with one sentence.
int calibrate_pads(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again, int answers);

}  // namespace gearshift::ui
