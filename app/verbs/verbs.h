// The verbs of the program. Each adds its subcommand and, when chosen, sets the action to run.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace gearshift {

// Returns the exit code: 0 done, 1 the work failed. Bad usage (2) is thrown as CLI::ValidationError or
// FileError before or by the action; main turns exceptions into one sentence on stderr.
using VerbAction = std::function<int()>;

void add_gate_verb(CLI::App& app, VerbAction& action);
void add_tour_verb(CLI::App& app, VerbAction& action);
void add_replay_verb(CLI::App& app, VerbAction& action);
void add_bench_verb(CLI::App& app, VerbAction& action);

}  // namespace gearshift
