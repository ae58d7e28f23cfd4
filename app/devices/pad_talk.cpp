#include "app/devices/pad_talk.h"

#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <fmt/core.h>

#include "app/devices/answers.h"
#include "app/devices/calibration_talk.h"
#include "app/devices/stop_signals.h"
#include "app/input/axis_learner.h"
#include "app/print_out.h"
#include "engine/window/glfw_use.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

constexpr int kRestFrames = 100;
constexpr std::chrono::milliseconds kFrame{10};

struct Control {
  std::optional<AxisBinding> Bindings::*axis;
  AxisLearner::Control kind;
  const char* shown;  // what the person does
};

constexpr Control kControls[] = {
    {&Bindings::clutch, AxisLearner::Control::pedal, "Press the CLUTCH pedal all the way and let go of it"},
    {&Bindings::brake, AxisLearner::Control::pedal, "Press the BRAKE pedal all the way and let go of it"},
    {&Bindings::throttle, AxisLearner::Control::pedal, "Press the THROTTLE pedal all the way and let go of it"},
    {&Bindings::lever_select, AxisLearner::Control::lever, "Move the LEVER to the left, then to the right, and let go"},
    {&Bindings::lever_shift, AxisLearner::Control::lever, "Move the LEVER back, then forward, and let go"}};

// True where it was learnt; false where it is left out.
bool learn(const Control& control, Bindings& bindings, const PadTalk& talk) {
  for (;;) {
    AxisLearner learner(control.kind);
    const std::string answer = talk.ask(fmt::format("{}. [Enter when done, - leaves it out]", control.shown),
                                        [&] { learner.watch_move(talk.next_frame()); });
    if (answer == "-") return false;
    if (!answer.empty()) {
      talk.say(fmt::format("\"{}\" is no answer here.", printable(answer)));
      continue;
    }
    talk.say("Leave all of it alone for a second.");
    for (int i = 0; i < kRestFrames; ++i) learner.watch_rest(talk.next_frame());
    try {
      bindings.*control.axis = learner.answer();
      const AxisBinding& found = *(bindings.*control.axis);
      talk.say(fmt::format("  Found: axis {} of {}, from {:.2f} to {:.2f}.", found.axis + 1, found.stick, found.from,
                           found.to));
      return true;
    } catch (const std::invalid_argument& refused) {
      talk.say(fmt::format("  Not taken: {}. Once more.", refused.what()));
    }
  }
}

LeverMode asked_mode(const PadTalk& talk) {
  for (;;) {
    const std::string answer = talk.ask("Does the lever stay where it is put, without a hand? [y or n]", [] {});
    if (answer == "y") return LeverMode::places;
    if (answer == "n") return LeverMode::moves;
    talk.say(fmt::format("\"{}\" is no answer here.", printable(answer)));
  }
}

std::string ask_line(Answers& answers, const std::string& question, const std::function<void()>& frame) {
  print_line(question);
  for (;;) {
    if (const std::optional<std::string> line = answers.line(0.0)) return *line;
    if (StopSignals::asked()) throw CalibrationEnded("ended: nothing is changed");
    if (answers.ended()) throw CalibrationEnded("standard input is at its end: nothing is changed");
    frame();
    std::this_thread::sleep_for(kFrame / 2);
  }
}

}  // namespace

Bindings bindings_before(const std::filesystem::path& file, const std::filesystem::path& usual, bool again) {
  std::error_code ignored;
  if (!again && std::filesystem::exists(file, ignored)) return read_bindings(file);
  Bindings bindings = read_bindings(usual);
  for (const Control& control : kControls) (bindings.*control.axis).reset();
  return bindings;
}

namespace {

void keep(const Bindings& bindings, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) throw FileError(file.parent_path().string(), 0, "cannot be made: " + error.message());
  write_bindings(bindings, file);
}

}  // namespace

Bindings learn_axes(Bindings bindings, const PadTalk& talk) {
  bool has_lever = false;
  for (const Control& control : kControls) {
    const bool found = learn(control, bindings, talk);
    has_lever = has_lever || (found && control.kind == AxisLearner::Control::lever);
  }
  if (has_lever) bindings.lever_mode = asked_mode(talk);
  return bindings;
}

int calibrate_pads(const std::filesystem::path& file, const std::filesystem::path& usual, bool again, int descriptor) {
  const StopSignals signals;
  const GlfwUse glfw;
  Answers answers(descriptor);
  PadTalk talk;
  talk.say = print_line;
  talk.ask = [&](const std::string& question, const std::function<void()>& frame) {
    return ask_line(answers, question, frame);
  };
  talk.next_frame = [] {
    std::this_thread::sleep_for(kFrame);
    return read_pads();
  };
  try {
    keep(learn_axes(bindings_before(file, usual, again), talk), file);
  } catch (const CalibrationEnded& ended) {
    print_line(ended.what());
    return 1;
  }
  print_line(fmt::format("Kept: {}", file.string()));
  return 0;
}

}  // namespace gearshift
