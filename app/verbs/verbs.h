// The verbs of the program. Each function add_..._verb() adds a subcommand. When the user chooses the subcommand, it
// sets `action`.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace gearshift::verbs {

// Runs a verb. Returns the exit code: 0 for success, 1 if the verb failed. If the function throws, main() prints the
// exception as one sentence to stderr. The exit code is then 2 for bad usage (CLI::ParseError), otherwise 1.
using VerbAction = std::function<int()>;

// Parses the command line and returns the action of the chosen verb, or the action of `train` if there is no verb.
// Throws CLI::ParseError for bad usage and for --help.
VerbAction parse_command_line(CLI::App& app, int argc, const char* const* argv);
std::string usage_sentence(const CLI::ParseError& refusal);  // the message, with control characters made printable

struct TourArguments;
int run_demo(const TourArguments& tour);  // runs the verb `demo`; all its other options have their default values

void add_train_verb(CLI::App& app, VerbAction& action);
void add_demo_verb(CLI::App& app, VerbAction& action);
void add_render_verb(CLI::App& app, VerbAction& action);
void add_gate_verb(CLI::App& app, VerbAction& action);
void add_lesson_verb(CLI::App& app, VerbAction& action);
void add_drive_verb(CLI::App& app, VerbAction& action);
void add_tour_verb(CLI::App& app, VerbAction& action);
void add_shifter_verb(CLI::App& app, VerbAction& action);
void add_identify_verb(CLI::App& app, VerbAction& action);
void add_stability_verb(CLI::App& app, VerbAction& action);
void add_contact_verb(CLI::App& app, VerbAction& action);
void add_reproduce_verb(CLI::App& app, VerbAction& action);
void add_replay_verb(CLI::App& app, VerbAction& action);
void add_report_verb(CLI::App& app, VerbAction& action);
void add_school_verb(CLI::App& app, VerbAction& action);
void add_parameters_verb(CLI::App& app, VerbAction& action);
void add_devices_verb(CLI::App& app, VerbAction& action);
void add_campaign_verb(CLI::App& app, VerbAction& action);
void add_bench_verb(CLI::App& app, VerbAction& action);

}  // namespace gearshift::verbs
