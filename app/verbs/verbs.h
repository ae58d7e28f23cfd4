// The verbs of the program. Each adds its subcommand and, when chosen, sets the action to run.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace gearshift {

// Returns the exit code: 0 done, 1 the work failed. main turns what is thrown into one sentence on stderr:
// bad usage, a CLI::ParseError, exits 2; anything else, a FileError included, exits 1.
using VerbAction = std::function<int()>;

// What a command line asks for; without a verb it is the trainer. Throws CLI::ParseError: bad usage, or help that is asked
// for.
VerbAction parse_command_line(CLI::App& app, int argc, const char* const* argv);
std::string usage_sentence(const CLI::ParseError& refusal);  // what it names may be shown on a terminal

struct TourArguments;
int run_demo(const TourArguments& tour);  // as `demo` does with nothing but these

void add_train_verb(CLI::App& app, VerbAction& action);
void add_demo_verb(CLI::App& app, VerbAction& action);
void add_render_verb(CLI::App& app, VerbAction& action);
void add_gate_verb(CLI::App& app, VerbAction& action);
void add_lesson_verb(CLI::App& app, VerbAction& action);
void add_tour_verb(CLI::App& app, VerbAction& action);
void add_identify_verb(CLI::App& app, VerbAction& action);
void add_stability_verb(CLI::App& app, VerbAction& action);
void add_reproduce_verb(CLI::App& app, VerbAction& action);
void add_replay_verb(CLI::App& app, VerbAction& action);
void add_report_verb(CLI::App& app, VerbAction& action);
void add_devices_verb(CLI::App& app, VerbAction& action);
void add_campaign_verb(CLI::App& app, VerbAction& action);
void add_bench_verb(CLI::App& app, VerbAction& action);

}  // namespace gearshift
