// Which axis of which stick, pad or pedals is the clutch, the brake, the throttle and the lever: a person shows them one
// after another. Needs no force feedback: GLFW tells of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/input/bindings.h"

namespace gearshift {

struct PadTalk {
  std::function<void(const std::string& line)> say;
  // A line of answer to that question; until it comes `frame` is called, some hundred times a second. Throws
  // CalibrationEnded.
  std::function<std::string(const std::string& question, const std::function<void()>& frame)> ask;
  std::function<std::vector<PadState>()> next_frame;  // what is plugged in, some milliseconds later
};

// These bindings with the axes that were shown; one that is left out stays as it is. Throws what talk throws.
Bindings learn_axes(Bindings bindings, const PadTalk& talk);

// What that starts from: the bindings in that file, or, where there are none or all is shown again, `usual` without its
// axes. Throws FileError.
Bindings bindings_before(const std::filesystem::path& file, const std::filesystem::path& usual, bool again);

// devices --calibrate for them. The file stays as it was until all was shown. answers: a file descriptor. Returns the exit
// code. Throws FileError, std::runtime_error with one sentence.
int calibrate_pads(const std::filesystem::path& file, const std::filesystem::path& usual, bool again, int answers);

}  // namespace gearshift
