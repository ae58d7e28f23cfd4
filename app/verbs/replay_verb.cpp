// gearshift replay: runs a recorded drive again and says whether it came out the same, or exports it.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/learner/lesson_drive.h"
#include "app/program_name.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/verbs.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift {
namespace {

constexpr const char* kFooter =
    "A trace holds everything that came into each haptic cycle, the configuration and the gate.\n"
    "replay feeds the inputs to the same cycle again and compares every output by its exact bits.\n"
    "\n"
    "Exit code: 0 bit for bit (or exported, with --torn), 1 a difference or a bad file, 2 bad usage.\n"
    "\n"
    "  gearshift replay tour.trace\n"
    "  gearshift replay tour.trace --csv tour.csv\n"
    "  gearshift replay killed.trace --torn --csv rescued.csv";

struct ReplayOptions {
  std::filesystem::path trace;
  std::filesystem::path csv;
  bool torn = false;
};

// Opening the CSV file empties it: it must not be the trace that is being read.
void check_paths(const ReplayOptions& options) {
  std::error_code not_there;
  if (!options.csv.empty() && std::filesystem::equivalent(options.trace, options.csv, not_there))
    throw CLI::ValidationError("--csv", "the CSV file and the trace must be two files");
}

std::optional<TraceCsvFile> open_csv(const ReplayOptions& options) {
  if (options.csv.empty()) return std::nullopt;
  return TraceCsvFile(options.csv);
}

double share(std::uint64_t cycles, const TraceReader& reader) {
  return static_cast<double>(cycles) / static_cast<double>(reader.cycles());
}

int say(const ReplayResult& result, const TraceReader& reader) {
  if (result.bit_for_bit()) {
    fmt::print("bit for bit: {} cycles, {:.3f} s, hash {:016x}\n", result.cycles, result.seconds, result.replayed_hash);
    return 0;
  }
  if (!result.first) {
    fmt::print("not the recorded parameters: the hash is {:016x}, recorded was {:016x}\n", result.replayed_hash,
               result.recorded_hash);
    return 1;
  }
  fmt::print("differs first in cycle {}: {} is {}, recorded was {}\n", result.first->cycle, result.first->field,
             result.first->replayed, result.first->recorded);
  if (reader.header().program != program_name())
    fmt::print("it was recorded by {}, this is {}\n", reader.header().program, program_name());
  return 1;
}

std::unique_ptr<LeverWorld> make_world(const std::string& name, const Gate& gate) {
  std::unique_ptr<LeverWorld> nothing = make_null_world(name, gate);
  return nothing ? std::move(nothing) : make_lesson_world(name, gate);
}

// Goes through the file once: exports every cycle, and replays up to the first difference.
int replay_file(const ReplayOptions& options) {
  TraceReader reader(options.trace);
  Replayer replayer(reader.header(), options.trace.string(), make_world);
  std::optional<TraceCsvFile> csv = open_csv(options);
  ProgressBar progress;
  std::uint64_t cycles = 0;
  bool same = true;
  for (TraceSample sample; reader.next(sample); progress.show("replay", share(++cycles, reader))) {
    if (csv) csv->add(sample);
    if (same) same = replayer.step(sample);
  }
  progress.clear();
  if (csv) csv->finish();
  return say(replayer.finish(reader.hash()), reader);
}

int export_torn(const ReplayOptions& options) {
  TraceReader reader(options.trace, TornTrace::salvage);
  TraceCsvFile csv(options.csv);
  ProgressBar progress;
  std::uint64_t cycles = 0;
  for (TraceSample sample; reader.next(sample); progress.show("export", share(++cycles, reader))) csv.add(sample);
  progress.clear();
  csv.finish();
  fmt::print("{}: {} cycles exported, not replayed\n", reader.torn() ? "torn" : "whole", cycles);
  return 0;
}

}  // namespace

void add_replay_verb(CLI::App& app, VerbAction& action) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb = app.add_subcommand("replay", "run a recorded trace again, bit for bit, or export it");
  verb->footer(kFooter);
  verb->add_option("trace", options->trace, "trace file to run again")->required()->type_name("TRACE");
  CLI::Option* csv =
      verb->add_option("--csv", options->csv, "also write every cycle as a CSV line, units in the header");
  csv->type_name("FILE");
  verb->add_flag("--torn", options->torn, "export the intact cycles of a torn or damaged trace; replays nothing")
      ->needs(csv);
  verb->callback([options, &action] {
    check_paths(*options);
    action = [options] { return options->torn ? export_torn(*options) : replay_file(*options); };
  });
}

}  // namespace gearshift
