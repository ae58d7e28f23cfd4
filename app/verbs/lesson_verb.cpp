// gearshift lesson: a simulated learner drives a lesson, no graphics, and the coach says what it was.
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/history/history.h"
#include "app/trainer/user_folder.h"
#include "app/verbs/lesson_options.h"
#include "app/verbs/lesson_trials.h"
#include "app/verbs/number_between.h"
#include "app/verbs/two_files.h"
#include "app/verbs/verbs.h"
#include "app/verbs/whole_number.h"
#include "haptics/files/printable.h"
#include "haptics/loop/trace_format.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLessonHelp =
    "A simulated learner drives a lesson, as fast as it goes: what the coach says, the grade. With --learner it is "
    "remembered and recorded, as a person's.";
constexpr const char* kLessonExamples =
    "\nExit code: 0 passed (of several runs: the last), 1 not passed, ended early or a bad file, 2 bad usage.\n"
    "A history that cannot be used is told in one sentence, and the lesson is driven without it.\n"
    "\nExamples:\n"
    "  gearshift lesson hill_start                               by someone who can\n"
    "  gearshift lesson hill_start --skill-error 1 --seed 4      by someone who begins: exits 1\n"
    "  gearshift lesson hill_start --fault rollback              by someone who can, but for that: exits 1\n"
    "  gearshift lesson skip_shifts --trace drive.trace          for gearshift replay\n"
    "  gearshift lesson reverse --learner Kim --runs 8 --guided  for gearshift report, and for the trainer\n";

struct LessonArguments {
  std::string lesson, car, gate, trace;
  std::vector<std::string> faults;
  double skill_error = 0.0, amount = 1.0, guidance = 0.0;
  std::uint64_t seed = 1;
  std::string learner, database;
  std::optional<LessonMode> mode;
  int runs = 1;
  bool guided = false, verbose = false;
};

// An option goes before the lesson's own words, these before what is usual.
std::string first_of(const std::string& option, const std::string& lesson, const std::string& usual) {
  if (!option.empty()) return option;
  return lesson.empty() ? usual : lesson;
}

// Of gate and car their files, of the learner what a person could not be asked for.
std::string settings_of(const LessonDriveConfig& drive, const LessonArguments& arguments) {
  std::string text = fmt::format("gate = \"{}\"\ncar = \"{}\"\nsimulated_skill_error = {:g}\n", drive.gate.file,
                                 drive.car.file, arguments.skill_error);
  for (const std::string& key : arguments.faults)
    text += fmt::format("simulated_fault = \"{}\"  # {:g}\n", key, arguments.amount);
  return text;
}

// SQLite has files of its own beside it.
void check_history(const std::string& trace, const fs::path& history) {
  if (history.empty()) return;
  for (const char* own : {"", "-wal", "-shm", "-journal"})
    check_two_files("--trace", "the recording and the history", trace, history.string() + own);
}

// Whoever mistypes a name must not lose a history for it, nor anything else that is no recording.
void check_recording(const std::string& trace) {
  std::error_code error;
  if (trace.empty() || !std::filesystem::is_regular_file(trace, error) || std::filesystem::is_empty(trace, error))
    return;
  std::array<char, kTraceMagic.size()> first{};
  std::ifstream(trace, std::ios::binary).read(first.data(), first.size());
  if (first != kTraceMagic)
    throw CLI::ValidationError("--trace", printable(trace) + " is there, and is no recording: it is not written over");
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
  for (const std::string& read : {config.lesson.file, config.car.file, config.gate.file})
    check_two_files("--trace", "the recording and what is driven", arguments.trace, read);
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
  if (!arguments.learner.empty()) trials.history = history_place(arguments.database);
  check_history(arguments.trace, trials.history.file);
  trials.settings = settings_of(trials.drive, arguments);
  trials.tells_shifts = arguments.verbose;
  return trials;
}

int run_lesson(const LessonArguments& arguments) {
  return drive_trials(make_trials(arguments)) ? 0 : 1;
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
  CLI::Option* guidance =
      verb->add_option("--guidance", arguments->guidance, "strength of the teacher's hand; such a drive is not graded")
          ->check(number_between(0.0, 1.0))
          ->capture_default_str();
  verb->add_option("--seed", arguments->seed, "of the learner; each next run has the next one")
      ->check(whole_number())
      ->capture_default_str();
  CLI::Option* trace =
      verb->add_option("--trace", arguments->trace, "record the drive into this file")->type_name("FILE");
  CLI::Option* learner = verb->add_option("--learner", arguments->learner, "who drives: remembered and recorded")
                             ->type_name("NAME")
                             ->check(learner_name);
  verb->add_option("--database", arguments->database, "another history than the user's own; recordings/ lies beside it")
      ->type_name("FILE")
      ->needs(learner);
  verb->add_option("--runs", arguments->runs, "one after another")
      ->check(whole_number(1, 1'000'000))
      ->capture_default_str()
      ->excludes(trace);
  add_mode_option(*verb, arguments->mode);
  verb->add_flag("--guided", arguments->guided, "the coach helps as this learner's past runs ask for")
      ->excludes(guidance);
  verb->add_flag("--verbose", arguments->verbose, "a line for each shift, when it is written");
  verb->callback([arguments, &action] { action = [arguments] { return run_lesson(*arguments); }; });
}

}  // namespace gearshift
