#include "app/ui/input/axis_dialog.h"

#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <fmt/core.h>

#include "app/base/console.h"
#include "app/base/line_reader.h"
#include "app/base/stop_signals.h"
#include "app/runtime/devices/calibration_dialog.h"
#include "app/ui/input/axis_detector.h"
#include "engine/window/glfw_use.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"

namespace gearshift::ui {
namespace {

constexpr int kRestFrames = 100;
constexpr std::chrono::milliseconds kFrame{10};

struct Control {
  std::optional<AxisBinding> Bindings::*axis;
  AxisDetector::Control kind;
  const char* prompt;
};

constexpr Control kControls[] = {
    {&Bindings::clutch, AxisDetector::Control::pedal, "Press the CLUTCH pedal all the way down, then release it."},
    {&Bindings::brake, AxisDetector::Control::pedal, "Press the BRAKE pedal all the way down, then release it."},
    {&Bindings::throttle, AxisDetector::Control::pedal, "Press the THROTTLE pedal all the way down, then release it."},
    {&Bindings::lever_select, AxisDetector::Control::lever,
     "Move the LEVER to the left, then to the right, and let go."},
    {&Bindings::lever_shift, AxisDetector::Control::lever, "Move the LEVER back, then forward, and let go."}};

// Asks the user to move the control until its axis is found and assigned, or the user skips it. Returns false if
// skipped.
bool assign_axis(const Control& control, Bindings& bindings, const AxisDialog& dialog) {
  for (;;) {
    AxisDetector detector(control.kind);
    const std::string answer = dialog.ask(fmt::format("{} [Enter: done, -: skip]", control.prompt),
                                          [&] { detector.record_move(dialog.next_frame()); });
    if (answer == "-") return false;
    if (!answer.empty()) {
      dialog.print(fmt::format("\"{}\" is not a valid answer. Press Enter when done, or type - to skip.",
                               haptics::printable(answer)));
      continue;
    }
    dialog.print("Now don't touch anything for a second.");
    for (int i = 0; i < kRestFrames; ++i) detector.record_rest(dialog.next_frame());
    try {
      bindings.*control.axis = detector.result();
      const AxisBinding& found = *(bindings.*control.axis);
      dialog.print(fmt::format("  Found: axis {} of {}, from {:.2f} to {:.2f}.", found.axis + 1, found.stick,
                               found.from, found.to));
      return true;
    } catch (const std::invalid_argument& refused) {
      dialog.print(fmt::format("  {} Try again.", refused.what()));
    }
  }
}

LeverMode ask_lever_mode(const AxisDialog& dialog) {
  for (;;) {
    const std::string answer = dialog.ask("Does the lever stay in place when you let go of it? [y or n]", [] {});
    if (answer == "y") return LeverMode::places;
    if (answer == "n") return LeverMode::moves;
    dialog.print(fmt::format("\"{}\" is not a valid answer. Type y or n.", haptics::printable(answer)));
  }
}

std::string ask_line(base::LineReader& answers, const std::string& question, const std::function<void()>& frame) {
  base::print_line(question);
  for (;;) {
    if (const std::optional<std::string> line = answers.read_line(0.0)) return *line;
    if (base::StopSignals::requested()) throw runtime::CalibrationEnded("Stopped. Nothing was changed.");
    if (answers.at_end())
      throw runtime::CalibrationEnded("Stopped because standard input was closed. Nothing was changed.");
    frame();
    std::this_thread::sleep_for(kFrame / 2);
  }
}

}  // namespace

Bindings starting_bindings(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again) {
  std::error_code ignored;
  if (!again && std::filesystem::exists(file, ignored)) return read_bindings(file);
  Bindings bindings = read_bindings(defaults);
  for (const Control& control : kControls) (bindings.*control.axis).reset();
  return bindings;
}

namespace {

void save_bindings(const Bindings& bindings, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) throw haptics::FileError(file.parent_path().string(), 0, "cannot be created (" + error.message() + ")");
  write_bindings(bindings, file);
}

}  // namespace

Bindings learn_axes(Bindings bindings, const AxisDialog& dialog) {
  bool has_lever = false;
  for (const Control& control : kControls) {
    const bool found = assign_axis(control, bindings, dialog);
    has_lever = has_lever || (found && control.kind == AxisDetector::Control::lever);
  }
  if (has_lever) bindings.lever_mode = ask_lever_mode(dialog);
  return bindings;
}

int calibrate_pads(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again,
                   int descriptor) {
  const base::StopSignals signals;
  const engine::GlfwUse glfw;
  base::LineReader answers(descriptor);
  AxisDialog dialog;
  dialog.print = base::print_line;
  dialog.ask = [&](const std::string& question, const std::function<void()>& frame) {
    return ask_line(answers, question, frame);
  };
  dialog.next_frame = [] {
    std::this_thread::sleep_for(kFrame);
    return engine::read_pads();
  };
  try {
    save_bindings(learn_axes(starting_bindings(file, defaults, again), dialog), file);
  } catch (const runtime::CalibrationEnded& ended) {
    base::print_line(ended.what());
    return 1;
  }
  base::print_line(fmt::format("Saved: {}", file.string()));
  return 0;
}

}  // namespace gearshift::ui
