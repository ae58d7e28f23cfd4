// gearshift replay: runs a recorded drive again and says whether it came out the same, lists its shifts, or exports it.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/print_out.h"
#include "app/program_name.h"
#include "app/replay/recorded_drive.h"
#include "app/training/lesson_world.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/two_files.h"
#include "app/verbs/verbs.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_reader.h"
#include "tests/bench/campaign/broken_laws.h"

namespace gearshift {
namespace {

constexpr const char* kFooter =
    "A trace holds everything that came into each haptic cycle, the configuration and the gate.\n"
    "replay feeds the inputs to the same cycle again and compares every output by its exact bits. What the campaign\n"
    "has written beside a trace, which law it breaks, is said with the command that shows it.\n"
    "\n"
    "Exit code: 0 bit for bit (or exported, with --torn; or listed, with --shifts), 1 a difference or a bad file, 2 "
    "bad "
    "usage.\n"
    "\n"
    "  gearshift replay tour.trace\n"
    "  gearshift replay tour.trace --csv tour.csv\n"
    "  gearshift replay lesson.trace --shifts\n"
    "  gearshift replay killed.trace --torn --csv rescued.csv";

struct ReplayOptions {
  std::filesystem::path trace;
  std::filesystem::path csv;
  bool torn = false;
  bool shifts = false;
};

double share(std::uint64_t cycles, const TraceReader& reader) {
  return static_cast<double>(cycles) / static_cast<double>(reader.cycles());
}

int say(const ReplayResult& result, const TraceReader& reader) {
  if (result.bit_for_bit()) {
    print_out("bit for bit: {} cycles, {:.3f} s, hash {:016x}\n", result.cycles, result.seconds, result.replayed_hash);
    return 0;
  }
  if (!result.first) {
    print_out("not the recorded parameters: the hash is {:016x}, recorded was {:016x}\n", result.replayed_hash,
              result.recorded_hash);
    return 1;
  }
  print_out("differs first in cycle {}: {} is {}, recorded was {}\n", result.first->cycle, result.first->field,
            result.first->replayed, result.first->recorded);
  if (reader.header().program != program_name())
    print_out("it was recorded by {}, this is {}\n", reader.header().program, program_name());
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
  std::optional<TraceCsvFile> csv;
  if (!options.csv.empty()) csv.emplace(options.csv);
  ProgressBar progress;
  std::uint64_t cycles = 0;
  bool same = true;
  for (TraceSample sample; reader.next(sample); progress.show("replay", share(++cycles, reader))) {
    if (csv) csv->add(sample);
    if (same) same = replayer.step(sample);
  }
  progress.clear();
  if (csv) csv->finish();
  const int code = say(replayer.finish(reader.hash()), reader);
  print_out("{}", told_of(options.trace));
  return code;
}

int export_torn(const ReplayOptions& options) {
  TraceReader reader(options.trace, TornTrace::salvage);
  TraceCsvFile csv(options.csv);
  ProgressBar progress;
  std::uint64_t cycles = 0;
  for (TraceSample sample; reader.next(sample); progress.show("export", share(++cycles, reader))) csv.add(sample);
  progress.clear();
  csv.finish();
  print_out("{}: {} cycles exported, not replayed\n", reader.torn() ? "torn" : "whole", cycles);
  return 0;
}

void print_shift(const ShiftRecord& shift, double begin) {
  const std::string change = fmt::format("{} -> {}", gear_name(shift.from), gear_name(shift.to));
  print_out("{:>5}  {:>8.2f}  {:<7}  {:>8.2f} {:>8.2f} {:>8.2f}  {}\n", shift.number + 1, shift.begin - begin, change,
            shift.clutch_time, shift.lever_time, shift.end - shift.begin, shift.missed ? "missed" : "");
}

// Of what is whole. A second run that differs ends the list.
int list_shifts(const ReplayOptions& options) {
  const RecordedDrive drive(options.trace);
  if (!drive.has_car()) print_out("a drive without a car: it has no shifts\n");
  if (!drive.shifts().empty()) print_out("shift   begin s  gears    clutch s  lever s  whole s\n");
  for (const RecordedShift& shift : drive.shifts()) print_shift(shift.record, drive.begin());
  const std::size_t shifts = drive.shifts().size();
  if (drive.has_car())
    print_out("{} {} in {:.1f} s\n", shifts, shifts == 1 ? "shift" : "shifts", drive.end() - drive.begin());
  if (!drive.differs()) return 0;
  print_out("it differs from the recording: gearshift replay without --shifts says where\n");
  return 1;
}

int run_replay(const ReplayOptions& options) {
  if (options.shifts) return list_shifts(options);
  return options.torn ? export_torn(options) : replay_file(options);
}

}  // namespace

void add_replay_verb(CLI::App& app, VerbAction& action) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb =
      app.add_subcommand("replay", "Run a recorded trace again, bit for bit; list its shifts, or export it");
  verb->footer(kFooter);
  verb->add_option("trace", options->trace, "trace file to run again")->required()->type_name("TRACE");
  CLI::Option* csv =
      verb->add_option("--csv", options->csv, "also write every cycle as a CSV line, units in the header");
  csv->type_name("FILE");
  verb->add_flag("--torn", options->torn, "export the intact cycles of a torn or damaged trace; replays nothing")
      ->needs(csv);
  verb->add_flag("--shifts", options->shifts, "list the shifts of the drive: when, which gears, how long")
      ->excludes(csv);
  verb->callback([options, &action] {
    check_two_files("--csv", "the CSV file and the trace", options->csv, options->trace);
    action = [options] { return run_replay(*options); };
  });
}

}  // namespace gearshift
