// --mode, as every verb with lessons has it.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/training/lesson_result.h"

namespace gearshift {

inline void add_mode_option(CLI::App& verb, std::optional<LessonMode>& mode) {
  verb.add_option_function<std::string>(
          "--mode",
          [&mode](const std::string& name) {
            mode = name == "follow-me" ? LessonMode::follow_me : LessonMode::by_yourself;
          },
          "each step is prompted, or only the goal; else follow-me until it was passed")
      ->check(CLI::IsMember({"follow-me", "by-yourself"}));
}

}  // namespace gearshift
