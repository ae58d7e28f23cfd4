#include "app/ui/input/controls_dialog.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "app/base/console.h"
#include "app/base/line_reader.h"
#include "app/base/stop_signals.h"
#include "app/ui/input/controls_setup.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"

namespace gearshift::ui {
namespace {

constexpr double kFrame = 0.01;  // [s]

std::string choices_text(const ControlsSetup& setup) {
  std::string text;
  for (const ControlsSetup::Choice& choice : setup.choices()) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", *choice.key == '\0' ? "Enter" : choice.key, choice.label);
    if (choice.answer == ControlsSetup::Answer::skip) text += fmt::format(" ({})", setup.if_skipped());
  }
  return text;
}

void answer(ControlsSetup& setup, const std::string& line) {
  const auto choices = setup.choices();
  const auto chosen =
      std::find_if(choices.begin(), choices.end(), [&](const auto& choice) { return choice.key == line; });
  if (chosen == choices.end())
    base::print_line(fmt::format("\"{}\" is not a valid answer.", haptics::printable(line)));
  else
    setup.answer(chosen->answer);
}

}  // namespace

Bindings starting_bindings(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again) {
  std::error_code ignored;
  return read_bindings(!again && std::filesystem::exists(file, ignored) ? file : defaults);
}

void save_bindings(const Bindings& bindings, const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) throw haptics::FileError(file.parent_path().string(), 0, "cannot be created (" + error.message() + ")");
  write_bindings(bindings, file);
}

int calibrate_controllers(const std::filesystem::path& file, const std::filesystem::path& defaults, bool again,
                          int descriptor) {
  const base::StopSignals signals;
  base::LineReader answers(descriptor);
  engine::Controllers controllers;
  ControlsSetup setup(starting_bindings(file, defaults, again), read_bindings(defaults), gears_to_set_up());
  std::string shown;
  while (!setup.is_over()) {
    const std::string question =
        setup.is_resting() ? setup.prompt() : fmt::format("{} [{}]", setup.prompt(), choices_text(setup));
    if (shown != question + setup.note()) {
      if (!setup.note().empty()) base::print_line("  " + setup.note());
      base::print_line(question);
    }
    shown = question + setup.note();
    std::optional<std::string> line;
    if (setup.is_resting())
      std::this_thread::sleep_for(std::chrono::duration<double>(kFrame));
    else
      line = answers.read_line(kFrame);
    setup.frame(controllers.poll(), kFrame);
    if (line) {
      answer(setup, *line);
      shown.clear();
    }
    const bool is_stopped = base::StopSignals::requested();
    if (!is_stopped && (line || !answers.at_end() || setup.is_resting())) continue;
    base::print_line(is_stopped ? "Stopped. Nothing was changed."
                                : "Stopped because standard input was closed. Nothing was changed.");
    return 1;
  }
  if (!setup.note().empty()) base::print_line("  " + setup.note());
  save_bindings(setup.bindings(), file);
  base::print_line(fmt::format("Saved: {}", file.string()));
  return 0;
}

}  // namespace gearshift::ui
