// The verbs of the program. Each function add_..._verb() adds a subcommand, which sets `action` when the user chooses
// it.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace gearshift::verbs {

// The work of a verb. Returns the exit code: 0 for success, 1 if the work failed. If it throws, main() prints the
// exception as one sentence to stderr and exits with 2 for bad usage (CLI::ParseError), with 1 for anything else.
using VerbAction = std::function<int()>;

// Parses the command line and returns the action of the chosen verb; without a verb, that of `train`. Throws
// CLI::ParseError for bad usage and for --help.
VerbAction parse_command_line(CLI::App& app, int argc, const char* const* argv);
std::string usage_sentence(const CLI::ParseError& refusal);  // the message, with control characters made printable

struct TourArguments;
int run_demo(const TourArguments& tour);  // runs `demo` with the defaults of all other options

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

}  // namespace gearshift::verbs
