// gearshift bench: measures speed and error; prints a table, CSV, JSON or a page with plots.
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/program_name.h"
#include "app/base/progress_bar.h"
#include "app/base/stop_signals.h"
#include "app/base/user_folders.h"
#include "app/lab/bench/bench_files.h"
#include "app/lab/bench/bench_page.h"
#include "app/lab/bench/curve_svg.h"
#include "app/lab/bench/last_run.h"
#include "app/lab/bench/rows/bench.h"
#include "app/lab/bench/trade_svg.h"
#include "app/lessons/history/utc_time.h"
#include "app/lessons/report/report_files.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/number_between.h"
#include "app/verbs/verbs.h"
#include "app/verbs/version_text.h"
#include "engine/gpu/gpu.h"
#include "haptics/files/atomic_file.h"
#include "haptics/files/printable.h"

namespace gearshift::verbs {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::vector<std::string> families;
  std::string csv_file, out, norms_file;
  bool json = false;
  lab::BenchOptions options;
};

std::string describe_gpu() {
  try {
    const engine::GpuTraits traits = engine::Gpu({}).traits();
    return traits.name + ", " + traits.driver;
  } catch (const std::exception&) {
    return {};  // no error, because most families need no GPU
  }
}

void report_problem(const std::string& problem) {
  base::print_message("{}", problem);
}

struct Interrupted {};

struct BenchMeasurement {
  std::vector<lab::MeasuredRow> rows;  // measured rows; if a family failed, its rows contain the reason
  bool is_complete = true;
};

// Measures the wanted families of rows. If a family fails, the other families are measured anyway. A signal such as
// Ctrl-C stops the run the next time that a family reports its progress.
BenchMeasurement measure(const BenchArguments& arguments) {
  base::ProgressBar progress;
  lab::BenchOptions options = arguments.options;
  options.progress = [&](std::string_view family, double fraction) {
    if (base::StopSignals::requested()) throw Interrupted();
    progress.show(family, fraction);
  };
  BenchMeasurement measured;
  for (const lab::NamedFamily& family : lab::bench_families()) {
    const auto& wanted = arguments.families;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), family.name) == wanted.end()) continue;
    try {
      options.progress(family.name, 0.0);
      for (lab::BenchRow& row : lab::run_family(family, options)) measured.rows.push_back({std::move(row)});
    } catch (const std::exception& problem) {
      progress.clear();
      const std::string why = haptics::printable(problem.what());
      report_problem(fmt::format("cannot measure family {}: {}", family.name, why));
      for (lab::BenchRow& row : lab::unmeasured_family(family, why)) measured.rows.push_back({std::move(row)});
      measured.is_complete = false;
    } catch (const Interrupted&) {
      progress.clear();
      report_problem(
          fmt::format("interrupted while measuring family {}: {}", family.name,
                      measured.rows.empty() ? "no family was completed" : "only completed families are reported"));
      measured.is_complete = false;
      break;
    }
  }
  return measured;
}

// False if the run has fewer repetitions or a different block length, because its results cannot be compared with those
// of full runs.
bool is_comparable(const lab::BenchOptions& options) {
  return !options.quick && options.jitter_block == lab::BenchOptions{}.jitter_block;
}

// Compares the run with this machine's last run, then saves it. A failure is reported but does not end the program, so
// that the results are not lost.
void compare_and_save(lab::BenchRun& run) {
  try {
    const fs::path file = lab::last_run_file(base::user_data_folder(), run.machine);
    const lab::LastRun last = lab::read_last_run(file, report_problem);
    lab::compare(run, last);
    lab::save_run(file, last, run);
  } catch (const std::exception& problem) {
    report_problem(
        fmt::format("{}; this run was not saved, so the next run cannot be compared with it", problem.what()));
  }
}

std::string plot_name(const lab::NamedFamily& family) {
  return std::string(family.name) + ".svg";
}

std::vector<lessons::ReportFile> format_files(const lab::BenchRun& run) {
  std::vector<lessons::ReportFile> files{
      {"bench.html", lab::bench_page(run)}, {"bench.csv", lab::bench_csv(run)}, {"bench.json", lab::bench_json(run)}};
  std::vector<lab::BenchRow> rows;
  for (const lab::MeasuredRow& measured : run.rows) rows.push_back(measured.row);
  for (const lab::NamedFamily& family : lab::bench_families()) {
    std::string svg = lab::trade_svg(family.name, rows);
    if (svg.empty()) svg = lab::curve_svg(family.name, rows);  // a family compares methods, or draws curves
    if (!svg.empty()) files.push_back({plot_name(family), std::move(svg)});
  }
  return files;
}

// Writes the result files. If a file cannot be written, reports the problem and writes the other files anyway, because
// the measurement took minutes. Called before anything is printed to stdout, which may be a closed pipe. Returns the
// completely written files in the --out folder. `all`: set to false if a file is missing.
std::vector<fs::path> write_files(const BenchArguments& arguments, std::optional<haptics::AtomicFile>& csv,
                                  const lab::BenchRun& run, bool& all) {
  std::vector<fs::path> written;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const std::exception& problem) {
      report_problem(problem.what());
      all = false;
    }
  };
  if (!arguments.out.empty()) {
    for (const lessons::ReportFile& file : format_files(run)) {
      attempt([&] {
        haptics::write_text_file(fs::path(arguments.out) / file.name, file.text);
        written.push_back(fs::path(arguments.out) / file.name);
      });
    }
  }
  if (!csv) return written;
  attempt([&] {
    csv->write(lab::bench_csv(run));
    csv->commit();
  });
  return written;
}

// The file with this machine's last run; empty if there is no user data folder.
fs::path last_run_path(const lab::Machine& machine) {
  try {
    return lab::last_run_file(base::user_data_folder(), machine);
  } catch (const std::exception&) {
    return {};  // compare_and_save() reports this problem
  }
}

void check_csv(const BenchArguments& arguments, const lab::Machine& machine) {
  if (arguments.csv_file.empty()) return;
  check_distinct_outputs("--csv", "the CSV file and the saved results of the last run", arguments.csv_file,
                         last_run_path(machine));
  if (arguments.out.empty()) return;
  std::vector<std::string> written{"bench.html", "bench.csv", "bench.json"};
  for (const lab::NamedFamily& family : lab::bench_families()) written.push_back(plot_name(family));
  for (const std::string& name : written)
    check_distinct_outputs("--csv", "the CSV file and the files written by --out", arguments.csv_file,
                           fs::path(arguments.out) / name);
}

// Writes the norms of practised simulated drivers. The old file is replaced only at the end.
int write_norms(const BenchArguments& arguments) {
  const base::StopSignals signals;
  haptics::AtomicFile file(arguments.norms_file);
  file.prepare();
  base::ProgressBar progress;
  lab::BenchOptions options = arguments.options;
  options.progress = [&](std::string_view what, double fraction) {
    if (base::StopSignals::requested()) throw Interrupted();
    progress.show(what, fraction);
  };
  try {
    const std::string text = lab::derive_norms(options);
    file.write(text);
    file.commit();
    return 0;
  } catch (const Interrupted&) {
    progress.clear();
    report_problem("interrupted; the norms were not written");
    return 1;
  }
}

int run_bench(const BenchArguments& arguments) {
  const lab::Machine machine = lab::this_machine(describe_gpu());
  check_csv(arguments, machine);
  const base::StopSignals signals;
  std::optional<haptics::AtomicFile> csv;
  if (!arguments.csv_file.empty()) csv.emplace(arguments.csv_file).prepare();  // detects a wrong path before measuring
  if (!arguments.out.empty()) base::make_folder(arguments.out);
  lab::BenchRun run{.program = base::program_name() + " " + commit_text(),
                    .date = lessons::format_utc(lessons::system_seconds()),
                    .quick = arguments.options.quick,
                    .machine = machine};
  const std::optional<lab::ProcessorTime> begin = lab::processor_time_now();
  BenchMeasurement measured = measure(arguments);
  if (measured.rows.empty()) return 1;
  run.rows = std::move(measured.rows);
  run.contention = lab::cpu_contention(begin, lab::processor_time_now());
  if (is_comparable(arguments.options)) compare_and_save(run);
  bool is_complete = measured.is_complete;
  const std::vector<fs::path> written = write_files(arguments, csv, run, is_complete);
  base::print_out("{}", arguments.json ? lab::bench_json(run) : lab::bench_table(run));
  for (const fs::path& file : written)
    if (!arguments.json) base::print_out("{}\n", file.string());
  return is_complete ? 0 : 1;
}

}  // namespace

void add_bench_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* verb = app.add_subcommand(
      "bench", "Measure the speed and accuracy of the haptic loop, driveline, graphics and learning");
  verb->footer(
      "Examples:\n"
      "  gearshift bench --quick\n"
      "  gearshift bench --family plant\n");
  std::vector<std::string> names;
  for (const lab::NamedFamily& family : lab::bench_families()) names.emplace_back(family.name);
  verb->add_option("--family", arguments->families, "measure only this family of benchmarks; may be repeated")
      ->check(CLI::IsMember(names));
  verb->add_flag("--quick", arguments->options.quick,
                 "use fewer repetitions: takes about a minute, but the results are too rough to quote or compare");
  verb->add_flag("--json", arguments->json, "print JSON to stdout");
  verb->add_option("--csv", arguments->csv_file, "also write the rows to this CSV file")->type_name("FILE");
  verb->add_option("--out", arguments->out,
                   "also write bench.html with plots, bench.csv, bench.json and FAMILY.svg to this folder")
      ->type_name("DIR");
  verb->add_option(
          "--norms", arguments->norms_file,
          "measure nothing; derive the norms of the lessons from practised simulated drivers and write them to "
          "this file. Takes several minutes; the shipped file is assets/lessons/norms/simulated.toml")
      ->type_name("FILE")
      ->excludes("--family", "--quick", "--json", "--csv", "--out");
  verb->add_option("--block", arguments->options.jitter_block,
                   "length of each measurement block in the families jitter and beside [s]; 1 with --quick. Blocks "
                   "shorter than the default are not checked against a goal, and only runs with the default length are "
                   "compared with the last run")
      ->check(number_between(1.0, 600.0))
      ->capture_default_str();
  verb->callback([arguments, verb, &action] {
    if (arguments->options.quick && verb->count("--block") == 0) arguments->options.jitter_block = 1.0;
    action = [arguments] {
      arguments->options.gate_folder = base::shipped_folder("gates").string();
      arguments->options.model_folder = base::shipped_folder("models").string();
      if (!arguments->norms_file.empty()) return write_norms(*arguments);
      return run_bench(*arguments);
    };
  });
}

}  // namespace gearshift::verbs
