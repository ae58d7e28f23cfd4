// gearshift replay: runs a recorded drive again and says whether it came out the same, or exports it.
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/verbs/verbs.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift {
namespace {

constexpr const char* kFooter =
    "A trace holds everything that came into each haptic cycle, the configuration and the gate. replay feeds "
    "the\n"
    "inputs to the same cycle again and compares every output by its exact bits.\n"
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

// A bar on a terminal, after the first second.
class ProgressBar {
 public:
  explicit ProgressBar(std::uint64_t total) : total_(total), shows_(isatty(STDERR_FILENO) == 1) {}
  ~ProgressBar() {
    if (drawn_) fmt::print(stderr, "\r{:60}\r", "");
  }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void step() {
    constexpr std::uint64_t kLookEvery = 4096;
    if (++done_ % kLookEvery != 0 || !shows_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::seconds(1) && !drawn_) return;
    if (now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    drawn_ = true;
    const std::uint64_t tenths = total_ == 0 ? 0 : done_ * 40 / total_;
    fmt::print(stderr, "\r[{:40}] {:3} %", std::string(tenths, '='), total_ == 0 ? 0 : done_ * 100 / total_);
    std::fflush(stderr);
  }

 private:
  std::uint64_t total_, done_ = 0;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  bool shows_, drawn_ = false;
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

int say(const ReplayResult& result, const TraceReader& reader) {
  if (result.bit_for_bit()) {
    fmt::print("bit for bit: {} cycles, {:.3f} s, hash {:016x}\n", result.cycles, result.seconds,
               result.replayed_hash);
    return 0;
  }
  if (!result.first) {
    fmt::print("not the recorded parameters: the hash is {:016x}, recorded was {:016x}\n",
               result.replayed_hash, result.recorded_hash);
    return 1;
  }
  fmt::print("differs first in cycle {}: {} is {}, recorded was {}\n", result.first->cycle,
             result.first->field, result.first->replayed, result.first->recorded);
  if (reader.header().program != GEARSHIFT_VERSION)
    fmt::print("it was recorded by gearshift {}, this is {}\n", reader.header().program, GEARSHIFT_VERSION);
  return 1;
}

// Goes through the file once: exports every cycle, and replays up to the first difference.
int replay_file(const ReplayOptions& options) {
  TraceReader reader(options.trace);
  Replayer replayer(reader.header(), options.trace.string());
  std::optional<TraceCsvFile> csv = open_csv(options);
  bool same = true;
  {
    ProgressBar progress(reader.cycles());
    for (TraceSample sample; reader.next(sample); progress.step()) {
      if (csv) csv->add(sample);
      if (same) same = replayer.step(sample);
    }
  }
  if (csv) csv->finish();
  return say(replayer.finish(reader.hash()), reader);
}

int export_torn(const ReplayOptions& options) {
  TraceReader reader(options.trace, TornTrace::salvage);
  TraceCsvFile csv(options.csv);
  std::uint64_t cycles = 0;
  {
    ProgressBar progress(reader.cycles());
    for (TraceSample sample; reader.next(sample); progress.step(), ++cycles) csv.add(sample);
  }
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
  verb->add_flag("--torn", options->torn,
                 "export the intact cycles of a torn or damaged trace; replays nothing")
      ->needs(csv);
  verb->callback([options, &action] {
    check_paths(*options);
    action = [options] { return options->torn ? export_torn(*options) : replay_file(*options); };
  });
}

}  // namespace gearshift
