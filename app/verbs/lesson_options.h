// Command-line options shared by the verbs that run lessons.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "app/lessons/assessment/lesson_result.h"
#include "app/lessons/history/user_text.h"

namespace gearshift::verbs {

// A CLI11 validator: returns the problem with the name, or an empty string if the name is valid.
inline std::string validate_learner_name(const std::string& name) {
  return lessons::user_text_problem(lessons::UserText::name, "a learner's name", name);
}

inline void add_mode_option(CLI::App& verb, std::optional<lessons::LessonMode>& mode) {
  verb.add_option_function<std::string>(
          "--mode",
          [&mode](const std::string& name) {
            mode = name == "follow-me" ? lessons::LessonMode::follow_me : lessons::LessonMode::by_yourself;
          },
          "follow-me prompts every step, by-yourself states only the goal; default: follow-me until the lesson is "
          "passed")
      ->check(CLI::IsMember({"follow-me", "by-yourself"}));
}

}  // namespace gearshift::verbs
