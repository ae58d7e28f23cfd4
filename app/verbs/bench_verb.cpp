// gearshift bench: speed against error, as a table, CSV, JSON or a page with plots.
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "app/assets_path.h"
#include "app/bench/bench_files.h"
#include "app/bench/bench_page.h"
#include "app/bench/last_run.h"
#include "app/bench/trade_svg.h"
#include "app/devices/stop_signals.h"
#include "app/history/date_text.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/program_name.h"
#include "app/report/report_files.h"
#include "app/trainer/user_folder.h"
#include "app/verbs/number_between.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/two_files.h"
#include "app/verbs/verbs.h"
#include "app/version/version_text.h"
#include "engine/gpu/gpu.h"
#include "haptics/files/part_file.h"
#include "haptics/files/printable.h"
#include "tests/bench/bench.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::vector<std::string> families;
  std::string csv_file, out;
  bool json = false;
  BenchOptions options;
};

std::string gpu_words() {
  try {
    const GpuTraits traits = Gpu({}).traits();
    return traits.name + ", " + traits.driver;
  } catch (const std::exception&) {
    return {};  // who measures a lever needs none
  }
}

void tell(const std::string& problem) {
  print_problem("{}", problem);
}

struct EndedEarly {};

struct Measured {
  std::vector<MeasuredRow> rows;  // of whole families, and why others have none
  bool is_whole = true;
};

// A family that cannot be measured costs no other. Ctrl-C and the like end all: a family is left where it next tells how
// far it is.
Measured measure(const BenchArguments& arguments) {
  ProgressBar progress;
  BenchOptions options = arguments.options;
  options.progress = [&](std::string_view family, double share) {
    if (StopSignals::asked()) throw EndedEarly();
    progress.show(family, share);
  };
  Measured measured;
  for (const NamedFamily& family : bench_families()) {
    const auto& wanted = arguments.families;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), family.name) == wanted.end()) continue;
    try {
      options.progress(family.name, 0.0);
      for (BenchRow& row : run_family(family, options)) measured.rows.push_back({std::move(row)});
    } catch (const std::exception& problem) {
      progress.clear();
      const std::string why = printable(problem.what());
      tell(fmt::format("the family {} cannot be measured: {}", family.name, why));
      for (BenchRow& row : unmeasured_family(family, why)) measured.rows.push_back({std::move(row)});
      measured.is_whole = false;
    } catch (const EndedEarly&) {
      progress.clear();
      tell(fmt::format("ended in the family {}: {}", family.name,
                       measured.rows.empty() ? "nothing was measured" : "what was measured before it is told"));
      measured.is_whole = false;
      break;
    }
  }
  return measured;
}

// Of other runs' figures: neither fewer repetitions nor other blocks are.
bool is_comparable(const BenchOptions& options) {
  return !options.quick && options.jitter_block == BenchOptions{}.jitter_block;
}

// What cannot be compared or kept is told: it never costs the results.
void compare_and_keep(BenchRun& run) {
  try {
    const fs::path file = last_run_file(user_data_folder(), run.machine);
    const LastRun last = read_last_run(file, tell);
    compare(run, last);
    keep_run(file, last, run);
  } catch (const std::exception& problem) {
    tell(fmt::format("{}; this run is not kept to compare the next with", problem.what()));
  }
}

std::string plot_name(const NamedFamily& family) {
  return std::string(family.name) + ".svg";
}

std::vector<ReportFile> files_of(const BenchRun& run) {
  std::vector<ReportFile> files{
      {"bench.html", bench_page(run)}, {"bench.csv", bench_csv(run)}, {"bench.json", bench_json(run)}};
  std::vector<BenchRow> rows;
  for (const MeasuredRow& measured : run.rows) rows.push_back(measured.row);
  for (const NamedFamily& family : bench_families()) {
    std::string svg = trade_svg(family.name, rows);
    if (!svg.empty()) files.push_back({plot_name(family), std::move(svg)});
  }
  return files;
}

// Minutes were measured: a file that fails is told and costs no other. Before stdout, whose reader may be gone. Files of
// the folder that are whole.
std::vector<fs::path> write_files(const BenchArguments& arguments, std::optional<PartFile>& csv, const BenchRun& run,
                                  bool& all) {
  std::vector<fs::path> written;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const std::exception& problem) {
      tell(problem.what());
      all = false;
    }
  };
  if (!arguments.out.empty()) {
    for (const ReportFile& file : files_of(run)) {
      attempt([&] {
        write_text_file(fs::path(arguments.out) / file.name, file.text);
        written.push_back(fs::path(arguments.out) / file.name);
      });
    }
  }
  if (!csv) return written;
  attempt([&] {
    csv->write(bench_csv(run));
    csv->keep();
  });
  return written;
}

// Where this machine's last run is kept; empty where nothing can be.
fs::path kept_results(const Machine& machine) {
  try {
    return last_run_file(user_data_folder(), machine);
  } catch (const std::exception&) {
    return {};  // said when it is needed
  }
}

void check_csv(const BenchArguments& arguments, const Machine& machine) {
  if (arguments.csv_file.empty()) return;
  check_two_files("--csv", "the table and the results kept of the last run", arguments.csv_file, kept_results(machine));
  if (arguments.out.empty()) return;
  std::vector<std::string> written{"bench.html", "bench.csv", "bench.json"};
  for (const NamedFamily& family : bench_families()) written.push_back(plot_name(family));
  for (const std::string& name : written)
    check_two_files("--csv", "the table and what --out writes", arguments.csv_file, fs::path(arguments.out) / name);
}

int run_bench(const BenchArguments& arguments) {
  const Machine machine = this_machine(gpu_words());
  check_csv(arguments, machine);
  const StopSignals signals;
  std::optional<PartFile> csv;
  if (!arguments.csv_file.empty()) csv.emplace(arguments.csv_file).prepare();  // a wrong path must not cost the results
  if (!arguments.out.empty()) make_folder(arguments.out);
  BenchRun run{.program = program_name() + " " + commit_text(),
               .date = date_text(system_seconds()),
               .quick = arguments.options.quick,
               .machine = machine};
  const std::optional<ProcessorTime> begin = processor_time_now();
  Measured measured = measure(arguments);
  if (measured.rows.empty()) return 1;
  run.rows = std::move(measured.rows);
  run.taken = taken_elsewhere(begin, processor_time_now());
  if (is_comparable(arguments.options)) compare_and_keep(run);
  bool is_whole = measured.is_whole;
  const std::vector<fs::path> written = write_files(arguments, csv, run, is_whole);
  print_out("{}", arguments.json ? bench_json(run) : bench_table(run));
  for (const fs::path& file : written)
    if (!arguments.json) print_out("{}\n", file.string());
  return is_whole ? 0 : 1;
}

}  // namespace

void add_bench_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* verb = app.add_subcommand("bench", "Speed against error: what the haptic loop costs and how good it is");
  verb->footer(
      "Examples:\n"
      "  gearshift bench --quick\n"
      "  gearshift bench --family plant\n");
  std::vector<std::string> names;
  for (const NamedFamily& family : bench_families()) names.emplace_back(family.name);
  verb->add_option("--family", arguments->families, "only these families; may be repeated")
      ->check(CLI::IsMember(names));
  verb->add_flag("--quick", arguments->options.quick,
                 "fewer repetitions, about a minute: a look, not figures to quote, nor to compare with the last run's");
  verb->add_flag("--json", arguments->json, "JSON on stdout");
  verb->add_option("--csv", arguments->csv_file, "also write the rows as CSV")->type_name("FILE");
  verb->add_option("--out", arguments->out, "also write bench.html with plots, bench.csv, bench.json, FAMILY.svg")
      ->type_name("DIR");
  verb->add_option(
          "--block", arguments->options.jitter_block,
          "seconds of each block of the families jitter and beside, 1 with --quick: shorter ones get no verdict, and a "
          "run with others than usual is not compared with the last")
      ->check(number_between(1.0, 600.0))
      ->capture_default_str();
  verb->callback([arguments, verb, &action] {
    if (arguments->options.quick && verb->count("--block") == 0) arguments->options.jitter_block = 1.0;
    action = [arguments] {
      arguments->options.gate_folder = shipped_folder("gates").string();
      arguments->options.model_folder = shipped_folder("models").string();
      return run_bench(*arguments);
    };
  });
}

}  // namespace gearshift
