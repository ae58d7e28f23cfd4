// Options of every verb with lessons.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include "app/history/history.h"
#include "app/training/lesson_result.h"

namespace gearshift {

// A check: what is wrong with the name, or nothing.
inline std::string learner_name(const std::string& name) {
  try {
    check_learner_name(name);
    return {};
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
}

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
