// gearshift bench: speed against error, as a table, CSV or JSON.
#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "app/assets_path.h"
#include "app/verbs/number_between.h"
#include "app/verbs/progress_bar.h"
#include "app/verbs/verbs.h"
#include "tests/bench/bench.h"

namespace gearshift {
namespace {

struct BenchArguments {
  std::vector<std::string> families;
  std::string csv_file;
  bool json = false;
  BenchOptions options;
};

void print_table(const std::vector<BenchRow>& rows) {
  fmt::print("{:<9} {:<58} {:>12} {:<20} {:>10}  {}\n", "family", "what", "value", "unit", "goal", "");
  for (const BenchRow& row : rows) {
    const std::string value = row.measured ? fmt::format("{:.4g}", row.value) : "-";
    const std::string goal = row.goal ? fmt::format("{} {:g}", row.at_least ? ">=" : "<=", *row.goal) : "";
    std::string note = row.note;
    for (const Beside& more : row.beside)
      note += fmt::format("{}{} {:.4g}{}{}", note.empty() ? "" : "; ", more.what, more.value,
                          more.unit.empty() ? "" : " ", more.unit);
    const char* verdict = !row.goal || !row.measured ? "" : meets_goal(row) ? "met" : "NOT MET";
    fmt::print("{:<9} {:<58} {:>12} {:<20} {:>10}  {:<8}{}\n", row.family, row.name, value, row.unit, goal, verdict,
               note);
  }
}

nlohmann::ordered_json to_json(const BenchRow& row) {
  nlohmann::ordered_json json{{"family", row.family}, {"name", row.name}, {"unit", row.unit}, {"note", row.note}};
  json["value"] = row.measured ? nlohmann::ordered_json(row.value) : nlohmann::ordered_json();
  if (row.goal) json["goal"] = *row.goal;
  if (row.goal) json["goal_is"] = row.at_least ? "at least" : "at most";
  if (row.goal && row.measured) json["met"] = meets_goal(row);
  for (const Beside& more : row.beside)
    json["beside"].push_back({{"what", more.what}, {"value", more.value}, {"unit", more.unit}});
  return json;
}

std::string beside_text(const BenchRow& row) {
  std::string text;
  for (const Beside& more : row.beside)
    text += fmt::format("{}{} = {} {}", text.empty() ? "" : "; ", more.what, more.value, more.unit);
  return text;
}

std::string csv_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// Opened before the first measurement: a wrong path must not cost the results.
std::ofstream open_csv(const std::string& file) {
  std::ofstream out;
  if (!file.empty()) out.open(file);
  if (!file.empty() && !out) throw std::runtime_error(file + ": cannot be written");
  return out;
}

void write_csv(std::ofstream& out, const std::string& file, const std::vector<BenchRow>& rows) {
  out << "family,what,value,unit,goal,note,beside\n";
  for (const BenchRow& row : rows) {
    out << row.family << ',' << csv_quoted(row.name) << ',' << (row.measured ? fmt::format("{}", row.value) : "") << ','
        << csv_quoted(row.unit) << ',' << (row.goal ? fmt::format("{}", *row.goal) : "") << ',' << csv_quoted(row.note)
        << ',' << csv_quoted(beside_text(row)) << '\n';
  }
  out.flush();
  if (!out) throw std::runtime_error(file + ": cannot be written");
}

std::vector<BenchRow> measure(const BenchArguments& arguments) {
  ProgressBar progress;
  BenchOptions options = arguments.options;
  options.progress = [&](std::string_view family, double share) { progress.show(family, share); };
  std::vector<BenchRow> rows;
  for (const NamedFamily& family : bench_families()) {
    const auto& wanted = arguments.families;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), family.name) == wanted.end()) continue;
    const std::vector<BenchRow> more = family.run(options);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

int run_bench(const BenchArguments& arguments) {
  std::ofstream csv = open_csv(arguments.csv_file);
  const std::vector<BenchRow> rows = measure(arguments);
  if (csv.is_open()) write_csv(csv, arguments.csv_file, rows);
  if (!arguments.json) {
    print_table(rows);
    return 0;
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const BenchRow& row : rows) json.push_back(to_json(row));
  fmt::print("{}\n", nlohmann::ordered_json{{"rows", json}}.dump(2));
  return 0;
}

}  // namespace

void add_bench_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* verb = app.add_subcommand("bench", "Speed against error: what the haptic loop costs and how good it is");
  std::vector<std::string> names;
  for (const NamedFamily& family : bench_families()) names.emplace_back(family.name);
  verb->add_option("--family", arguments->families, "only these families; may be repeated")
      ->check(CLI::IsMember(names));
  verb->add_flag("--quick", arguments->options.quick,
                 "fewer repetitions: a look, not figures to quote (jitter: one block of --block seconds)");
  verb->add_flag("--json", arguments->json, "JSON on stdout");
  verb->add_option("--csv", arguments->csv_file, "also write the rows as CSV")->type_name("FILE");
  verb->add_option("--block", arguments->options.jitter_block, "seconds of each block of the jitter family")
      ->check(number_between(1.0, 600.0))
      ->capture_default_str();
  verb->callback([arguments, &action] {
    arguments->options.gate_folder = (assets_folder() / "gates").string();
    arguments->options.model_folder = (assets_folder() / "models").string();
    action = [arguments] { return run_bench(*arguments); };
  });
}

}  // namespace gearshift
