// gearshift replay: re-simulates a recorded drive and compares it bit for bit, lists its shifts, or exports it.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "app/base/console.h"
#include "app/base/program_name.h"
#include "app/base/progress_bar.h"
#include "app/lab/campaign/broken_laws.h"
#include "app/lessons/replay/recorded_drive.h"
#include "app/vehicle/car_load.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/verbs.h"
#include "haptics/loop/replay.h"
#include "haptics/loop/trace_csv.h"
#include "haptics/loop/trace_reader.h"

namespace gearshift::verbs {
namespace {

constexpr const char* kFooter =
    "A trace contains the inputs of every haptic cycle, the configuration and the gate.\n"
    "replay computes every cycle again from these inputs and compares all outputs bit for bit. For a trace of a "
    "failed\n"
    "campaign case, it also prints the broken law and a command that reproduces the failure.\n"
    "\n"
    "Exit code: 0 if identical (with --torn: if exported; with --shifts: if listed); 1 if different or if the file is\n"
    "invalid; 2 if the command line is invalid.\n"
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

double done_fraction(std::uint64_t cycles, const haptics::TraceReader& reader) {
  return static_cast<double>(cycles) / static_cast<double>(reader.cycles());
}

int print_result(const haptics::ReplayResult& result, const haptics::TraceReader& reader) {
  if (result.bit_for_bit()) {
    base::print_out("identical bit for bit: {} cycles, {:.3f} s, hash {:016x}\n", result.cycles, result.seconds,
                    result.replayed_hash);
    return 0;
  }
  if (!result.first) {
    base::print_out("the parameters differ: replayed hash {:016x}, recorded hash {:016x}\n", result.replayed_hash,
                    result.recorded_hash);
    return 1;
  }
  base::print_out("first difference in cycle {}: {} is {} in the replay, {} in the recording\n", result.first->cycle,
                  result.first->field, result.first->replayed, result.first->recorded);
  if (reader.header().program != base::program_name())
    base::print_out("recorded by {}, replayed by {}\n", reader.header().program, base::program_name());
  return 1;
}

std::unique_ptr<haptics::LeverLoad> make_load(const std::string& name, const haptics::Gate& gate) {
  std::unique_ptr<haptics::LeverLoad> no_load = haptics::make_no_load(name, gate);
  return no_load ? std::move(no_load) : vehicle::make_car_load(name, gate);
}

// Reads the file once. Exports every cycle, and replays the cycles up to the first difference.
int replay_file(const ReplayOptions& options) {
  haptics::TraceReader reader(options.trace);
  haptics::Replayer replayer(reader.header(), options.trace.string(), make_load);
  std::optional<haptics::TraceCsvFile> csv;
  if (!options.csv.empty()) csv.emplace(options.csv);
  base::ProgressBar progress;
  std::uint64_t cycles = 0;
  bool same = true;
  for (haptics::TraceSample sample; reader.next(sample); progress.show("replay", done_fraction(++cycles, reader))) {
    if (csv) csv->add(sample);
    if (same) same = replayer.step(sample);
  }
  progress.clear();
  if (csv) csv->finish();
  const int code = print_result(replayer.finish(reader.hash()), reader);
  base::print_out("{}", lab::broken_laws_text(options.trace));
  return code;
}

int export_torn(const ReplayOptions& options) {
  haptics::TraceReader reader(options.trace, haptics::TornTrace::salvage);
  haptics::TraceCsvFile csv(options.csv);
  base::ProgressBar progress;
  std::uint64_t cycles = 0;
  for (haptics::TraceSample sample; reader.next(sample); progress.show("export", done_fraction(++cycles, reader)))
    csv.add(sample);
  progress.clear();
  csv.finish();
  base::print_out("{} trace: {} cycles exported, not replayed\n", reader.torn() ? "incomplete" : "complete", cycles);
  return 0;
}

void print_shift(const lessons::ShiftRecord& shift, double begin) {
  const std::string change = fmt::format("{} -> {}", haptics::gear_name(shift.from), haptics::gear_name(shift.to));
  base::print_out("{:>5}  {:>8.2f}  {:<7}  {:>8.2f} {:>8.2f} {:>8.2f}  {}\n", shift.number + 1, shift.begin - begin,
                  change, shift.clutch_time, shift.lever_time, shift.end - shift.begin, shift.missed ? "missed" : "");
}

// Lists the shifts up to the first cycle whose replay differs from the recording.
int list_shifts(const ReplayOptions& options) {
  const lessons::RecordedDrive drive(options.trace);
  if (!drive.has_car()) base::print_out("The drive has no car, so there are no shifts to list.\n");
  if (!drive.shifts().empty()) base::print_out("shift   begin s  gears    clutch s  lever s  total s\n");
  for (const lessons::RecordedShift& shift : drive.shifts()) print_shift(shift.record, drive.begin());
  const std::size_t shifts = drive.shifts().size();
  if (drive.has_car())
    base::print_out("{} {} in {:.1f} s\n", shifts, shifts == 1 ? "shift" : "shifts", drive.end() - drive.begin());
  if (!drive.has_diverged()) return 0;
  base::print_out("The replay differs from the recording. Run gearshift replay without --shifts to see where.\n");
  return 1;
}

int run_replay(const ReplayOptions& options) {
  if (options.shifts) return list_shifts(options);
  return options.torn ? export_torn(options) : replay_file(options);
}

}  // namespace

void add_replay_verb(CLI::App& app, VerbAction& action) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* verb = app.add_subcommand("replay", "Replay a recorded trace bit for bit, list its shifts, or export it");
  verb->footer(kFooter);
  verb->add_option("trace", options->trace, "trace file to replay")->required()->type_name("TRACE");
  CLI::Option* csv =
      verb->add_option("--csv", options->csv, "also write every cycle as a line of CSV, with units in the header");
  csv->type_name("FILE");
  verb->add_flag("--torn", options->torn,
                 "export the intact cycles of an incomplete or damaged trace without replaying them")
      ->needs(csv);
  verb->add_flag("--shifts", options->shifts, "list the shifts of the drive: time, gears, duration")->excludes(csv);
  verb->callback([options, &action] {
    check_distinct_outputs("--csv", "the CSV file and the trace", options->csv, options->trace);
    action = [options] { return run_replay(*options); };
  });
}

}  // namespace gearshift::verbs
