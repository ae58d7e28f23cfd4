// Options of every verb with lessons.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/history/typed_text.h"
#include "app/training/lesson_result.h"

namespace gearshift {

// A check: what is wrong with the name, or nothing.
inline std::string learner_name(const std::string& name) {
  return typed_text_problem(TypedText::name, "a learner's name", name);
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
