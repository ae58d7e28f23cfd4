// gearshift lesson: a simulated driver drives a lesson without graphics, and the coach prints errors and grade.
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/lessons/history/history.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/history_choice.h"
#include "app/verbs/lesson_options.h"
#include "app/verbs/lesson_trials.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/files/printable.h"
#include "haptics/loop/trace_format.h"

namespace gearshift::verbs {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLessonHelp =
    "Run a lesson with a simulated driver, faster than real time, and print the driving errors and the grade. With "
    "--learner, the run is saved and recorded like a person's.";
constexpr const char* kLessonExamples =
    "\nExit code: 0 if passed (with --runs: if the last run passed); 1 if not passed, interrupted, or a file is\n"
    "invalid; 2 if the command line is invalid.\n"
    "If the history cannot be used, a message explains why and the lesson runs without saving.\n"
    "\nExamples:\n"
    "  gearshift lesson hill_start                               a skilled driver\n"
    "  gearshift lesson hill_start --skill-error 1 --seed 4      a beginner: exits 1\n"
    "  gearshift lesson hill_start --fault rollback              a skilled driver who rolls back: exits 1\n"
    "  gearshift lesson skip_shifts --trace drive.trace          record it for gearshift replay\n"
    "  gearshift lesson reverse --learner Kim --runs 8 --guided  save it for gearshift report and the trainer\n";

struct LessonArguments {
  std::string lesson, car, gate, trace;
  std::vector<std::string> errors;
  double skill_error = 0.0, amount = 1.0, guidance = 0.0;
  std::uint64_t seed = 1;
  std::string learner, database;
  std::optional<lessons::LessonMode> mode;
  int runs = 1;
  bool guided = false, verbose = false, json = false;
};

// Returns the command-line option if it was given, otherwise the lesson's value, otherwise the fallback.
std::string first_of(const std::string& option, const std::string& lesson, const std::string& fallback) {
  if (!option.empty()) return option;
  return lesson.empty() ? fallback : lesson;
}

// Throws if the recording would overwrite the history or one of the files that SQLite keeps next to it.
void check_history(const std::string& trace, const fs::path& history) {
  if (history.empty()) return;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"})
    check_distinct_outputs("--trace", "the recording and the history", trace, history.string() + suffix);
}

// Throws if `trace` names an existing file that is not a recording, so that a mistyped name does not overwrite it.
void check_recording(const std::string& trace) {
  std::error_code error;
  if (trace.empty() || !std::filesystem::is_regular_file(trace, error) || std::filesystem::is_empty(trace, error))
    return;
  std::array<char, haptics::kTraceMagic.size()> first{};
  std::ifstream(trace, std::ios::binary).read(first.data(), first.size());
  if (first != haptics::kTraceMagic)
    throw CLI::ValidationError(
        "--trace", haptics::printable(trace) +
                       " already exists and is not a recording, so it was not overwritten; choose another file");
}

lessons::LessonDriveConfig make_drive(const LessonArguments& arguments) {
  lessons::LessonDriveConfig config;
  config.lesson = lessons::read_lesson(base::find_asset("lessons", arguments.lesson));
  config.car = vehicle::read_car(base::find_asset("cars", first_of(arguments.car, config.lesson.car, "hatchback")));
  config.gate = haptics::read_gearbox_layout(
      base::find_asset("gates", first_of(arguments.gate, config.lesson.gate, config.car.gate)));
  config.skill = lessons::skill_of(arguments.skill_error);
  for (const std::string& key : arguments.errors)
    config.errors.amount[static_cast<std::size_t>(*lessons::error_kind_of(key))] = arguments.amount;
  config.guidance = arguments.guidance;
  config.seed = arguments.seed;
  for (const std::string& read : {config.lesson.file, config.car.file, config.gate.file})
    check_distinct_outputs("--trace", "the recording and the files of the lesson, car and gate", arguments.trace, read);
  check_recording(arguments.trace);
  config.trace = arguments.trace;
  return config;
}

LessonTrials make_trials(const LessonArguments& arguments) {
  LessonTrials trials;
  trials.drive = make_drive(arguments);
  trials.runs = arguments.runs;
  trials.help = arguments.guided;
  trials.mode = arguments.mode;
  trials.learner = arguments.learner;
  if (!arguments.learner.empty()) {
    HistoryChoice history = choose_history(arguments.database);
    trials.history = history.place;
    trials.server = history.server;
  }
  check_history(arguments.trace, trials.history.file);
  trials.prints_shifts = arguments.verbose;
  trials.json = arguments.json;
  return trials;
}

int run_lesson(const LessonArguments& arguments) {
  return drive_trials(make_trials(arguments)) ? 0 : 1;
}

std::vector<std::string> error_keys() {
  std::vector<std::string> keys;
  for (int i = 0; i < lessons::kErrorKindCount; ++i)
    keys.emplace_back(lessons::to_string(static_cast<lessons::ErrorKind>(i)));
  return keys;
}

}  // namespace

void add_lesson_verb(CLI::App& app, VerbAction& action) {
  const auto arguments = std::make_shared<LessonArguments>();
  CLI::App* verb = app.add_subcommand("lesson", kLessonHelp);
  verb->footer(kLessonExamples);
  verb->add_option("lesson", arguments->lesson, "shipped lesson or lesson file")->required();
  verb->add_option("--car", arguments->car, "shipped car or car file; default: the lesson's");
  verb->add_option("--gate", arguments->gate, "shipped gate or layout file; default: the lesson's or the car's");
  verb->add_option("--skill-error", arguments->skill_error,
                   "the driver's lack of skill: 0 is a skilled driver, 1 is a beginner")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
  verb->add_option("--fault", arguments->errors, "driving error that the driver makes on purpose; may be repeated")
      ->check(CLI::IsMember(error_keys()));
  verb->add_option("--fault-amount", arguments->amount,
                   "how large the deliberate errors are; at 1 they are easy to notice")
      ->check(number_between(0.0, 3.0))
      ->capture_default_str();
  CLI::Option* guidance = verb->add_option("--guidance", arguments->guidance,
                                           "strength of the lever's guidance; guided runs are not graded")
                              ->check(number_between(0.0, 1.0))
                              ->capture_default_str();
  verb->add_option("--seed", arguments->seed, "seed of the simulated driver; increases by 1 with each run")
      ->check(whole_number())
      ->capture_default_str();
  CLI::Option* trace =
      verb->add_option("--trace", arguments->trace, "record the drive to this file")->type_name("FILE");
  CLI::Option* learner = verb->add_option("--learner", arguments->learner, "save and record the runs under this name")
                             ->type_name("NAME")
                             ->check(validate_learner_name);
  verb->add_option("--database", arguments->database,
                   "history file to use instead of your own, or postgresql:// URL of a school's server; recordings are "
                   "saved next "
                   "to the history file, in the folder recordings")
      ->type_name("FILE")
      ->needs(learner);
  verb->add_option("--runs", arguments->runs, "number of runs, one after another")
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str()
      ->excludes(trace);
  add_mode_option(*verb, arguments->mode);
  verb->add_flag("--guided", arguments->guided, "choose the guidance automatically from this learner's past runs")
      ->excludes(guidance);
  CLI::Option* verbose = verb->add_flag("--verbose", arguments->verbose, "print a line after each shift is saved");
  verb->add_flag("--json", arguments->json,
                 "print grade, verdict, errors, figures and shifts of each run as JSON instead")
      ->excludes(verbose);
  verb->callback([arguments, &action] { action = [arguments] { return run_lesson(*arguments); }; });
}

}  // namespace gearshift::verbs
