// gearshift lesson: a simulated learner drives a lesson, no graphics, and the coach says what it was.
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/learner/lesson_drive.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"

namespace gearshift {
namespace {

constexpr const char* kLessonHelp =
    "A simulated learner drives a lesson, as fast as it goes: what the coach says, the grade. Nothing is remembered.";
constexpr const char* kLessonExamples =
    "\nExit code: 0 passed, 1 not passed or a bad file, 2 bad usage.\n"
    "\nExamples:\n"
    "  gearshift lesson hill_start                               by someone who can\n"
    "  gearshift lesson hill_start --skill-error 1 --seed 4      by someone who begins\n"
    "  gearshift lesson hill_start --fault rollback              by someone who can, but for that\n"
    "  gearshift lesson skip_shifts --trace drive.trace          for gearshift replay\n";

struct LessonArguments {
  std::string lesson, car, gate, trace;
  std::vector<std::string> faults;
  double skill_error = 0.0, amount = 1.0, guidance = 0.0;
  std::uint64_t seed = 1;
};

// An option goes before the lesson's own words, these before what is usual.
std::string first_of(const std::string& option, const std::string& lesson, const std::string& usual) {
  if (!option.empty()) return option;
  return lesson.empty() ? usual : lesson;
}

LessonDriveConfig make_drive(const LessonArguments& arguments) {
  LessonDriveConfig config;
  config.lesson = read_lesson(find_asset("lessons", arguments.lesson));
  config.car = read_car(find_asset("cars", first_of(arguments.car, config.lesson.car, "hatchback")));
  config.gate = read_gate_layout(find_asset("gates", first_of(arguments.gate, config.lesson.gate, config.car.gate)));
  config.skill = skill_of(arguments.skill_error);
  for (const std::string& key : arguments.faults)
    config.faults.amount[static_cast<std::size_t>(*fault_of(key))] = arguments.amount;
  config.guidance = arguments.guidance;
  config.seed = arguments.seed;
  config.trace = arguments.trace;
  return config;
}

void print_result(const Lesson& lesson, const LessonResult& result) {
  fmt::print("{}: {}\n", lesson.title, lesson.goal);
  std::size_t next = 0;
  for (std::size_t i = 0; i < result.faults.size(); ++i) {
    const bool costs = next < result.deductions.size() && result.deductions[next].fault == i;
    const double points = costs ? result.deductions[next++].points : 0.0;
    const DriveFault& fault = result.faults[i];
    if (fault.severity == Severity::note) continue;
    fmt::print("  {:6.1f} s  {:<11}  -{:.1f}  {}\n", fault.time, severity_key(fault.severity), points,
               fault_sentence(fault));
  }
  fmt::print("{} shifts in {:.1f} s. ", result.shifts.size(), result.duration);
  if (!result.guided) fmt::print("Grade {:.1f} of 10. ", result.grade);
  fmt::print("{}\n", result.passed ? "Passed." : "Not passed: " + result.why);
}

int run_lesson(const LessonArguments& arguments) {
  const LessonDriveConfig config = make_drive(arguments);
  const LessonResult result = drive_lesson(config);
  print_result(config.lesson, result);
  return result.passed ? 0 : 1;
}

std::vector<std::string> fault_keys() {
  std::vector<std::string> keys;
  for (int i = 0; i < kFaultKinds; ++i) keys.emplace_back(fault_key(static_cast<FaultKind>(i)));
  return keys;
}

}  // namespace

void add_lesson_verb(CLI::App& app, VerbAction& action) {
  const auto arguments = std::make_shared<LessonArguments>();
  CLI::App* verb = app.add_subcommand("lesson", kLessonHelp);
  verb->footer(kLessonExamples);
  verb->add_option("lesson", arguments->lesson, "a shipped lesson, or a file")->required();
  verb->add_option("--car", arguments->car, "a shipped car, or a file; else the lesson's");
  verb->add_option("--gate", arguments->gate, "a shipped gate, or a file; else the lesson's or the car's");
  verb->add_option("--skill-error", arguments->skill_error, "0 practised to 1 a beginner")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  verb->add_option("--fault", arguments->faults, "done on purpose; may be repeated")
      ->check(CLI::IsMember(fault_keys()));
  verb->add_option("--fault-amount", arguments->amount, "of these; 1: nobody would overlook it")
      ->check(number_between(0.0, 3.0))
      ->capture_default_str();
  verb->add_option("--guidance", arguments->guidance, "strength of the teacher's hand; such a drive is not graded")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  verb->add_option("--seed", arguments->seed, "of the learner")->capture_default_str();
  verb->add_option("--trace", arguments->trace, "record the drive into this file")->type_name("FILE");
  verb->callback([arguments, &action] { action = [arguments] { return run_lesson(*arguments); }; });
}

}  // namespace gearshift
