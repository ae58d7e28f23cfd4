#include "app/bench/last_run.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "haptics/files/file_error.h"
#include "haptics/files/part_file.h"
#include "haptics/files/printable.h"
#include "haptics/files/text_file.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_bounded(const Quartiles& spread) {
  return std::isfinite(spread.low) && std::isfinite(spread.high);
}

Json to_json(const LastRun& last) {
  Json families = Json::object();
  for (const auto& [name, family] : last) {
    Json figures = Json::object();
    for (const auto& [row, figure] : family.figures) {
      figures[row]["value"] = figure.value;
      if (figure.spread && is_bounded(*figure.spread))
        figures[row]["quartiles"] = {figure.spread->low, figure.spread->high};
    }
    families[name] = {
        {"date", family.date}, {"program", family.program}, {"taken", family.taken}, {"figures", figures}};
  }
  return {{"families", families}};
}

// "2026-01-02T03:04:05Z": it goes to pages and terminals as it is.
bool is_date(std::string text) {
  for (char& c : text) c = c >= '0' && c <= '9' ? '0' : c;
  return text == "0000-00-00T00:00:00Z";
}

// Throws nlohmann's exceptions, or std::invalid_argument, for what is none of ours.
LastRun from_json(const Json& json) {
  LastRun last;
  for (const auto& [name, family] : json.at("families").items()) {
    LastFamily& into = last[name];
    into.date = family.at("date").get<std::string>();
    if (!is_date(into.date)) throw std::invalid_argument("no date");
    into.program = printable(family.value("program", ""));
    into.taken = printable(family.value("taken", ""));
    for (const auto& [row, figure] : family.at("figures").items()) {
      LastFigure& kept = into.figures[row];
      kept.value = figure.at("value").get<double>();
      if (figure.contains("quartiles"))
        kept.spread = Quartiles{figure["quartiles"].at(0).get<double>(), figure["quartiles"].at(1).get<double>()};
    }
  }
  return last;
}

std::string set_aside(const fs::path& file) {
  std::error_code problem;
  fs::path aside = file;
  aside += ".unreadable";
  for (int n = 2; fs::exists(fs::symlink_status(aside, problem)); ++n) {
    aside = file;
    aside += fmt::format(".unreadable{}", n);
  }
  fs::rename(file, aside, problem);
  return problem ? "it cannot be moved aside: " + problem.message() : "it is kept as " + aside.string();
}

// As a table shows it.
bool differs_as_shown(double a, double b) {
  return value_words(a) != value_words(b);
}

bool beyond_spread(const LastFigure& then, const BenchRow& now) {
  if (!differs_as_shown(then.value, now.value)) return false;
  if (!then.spread || !now.spread) return true;
  return now.spread->low > then.spread->high || now.spread->high < then.spread->low;
}

double ratio_of(double now, double then) {
  if (now == then) return 1.0;
  return then == 0.0 ? std::numeric_limits<double>::infinity() : now / then;
}

}  // namespace

fs::path last_run_file(const fs::path& folder, const Machine& machine) {
  return folder / "bench" / (machine_key(machine) + ".json");
}

LastRun read_last_run(const fs::path& file, const std::function<void(const std::string&)>& tell) {
  std::error_code unknown;
  if (fs::symlink_status(file, unknown).type() == fs::file_type::not_found) return {};
  std::string problem;
  try {
    return from_json(Json::parse(read_text_file(file)));
  } catch (const FileError& error) {
    problem = error.what();
  } catch (const std::exception&) {
    problem = file.string() + ": not a run of the bench";
  }
  tell(fmt::format("{}, so nothing is compared with it; {}", problem, set_aside(file)));
  return {};
}

std::optional<SinceLast> since_last(const LastRun& last, const BenchRow& row) {
  const auto family = last.find(row.family);
  if (family == last.end() || !row.measured) return std::nullopt;
  const auto figure = family->second.figures.find(row.name);
  if (figure == family->second.figures.end()) return std::nullopt;
  const LastFigure& then = figure->second;
  return SinceLast{.date = family->second.date,
                   .program = family->second.program,
                   .taken = family->second.taken,
                   .value = then.value,
                   .ratio = ratio_of(row.value, then.value),
                   .changed = beyond_spread(then, row)};
}

void compare(BenchRun& run, const LastRun& last) {
  for (MeasuredRow& measured : run.rows) {
    measured.since = since_last(last, measured.row);
    if (const auto cost = cost_row(measured.row)) measured.cost_since = since_last(last, *cost);
  }
}

void keep_run(const fs::path& file, LastRun last, const BenchRun& run) {
  const auto counts = [](const BenchRow& row) { return row.measured && std::isfinite(row.value); };
  for (const MeasuredRow& measured : run.rows) {
    if (counts(measured.row)) last.erase(measured.row.family);
  }
  const auto keep = [&](const BenchRow& row) {
    if (!counts(row)) return;
    LastFamily& family = last[row.family];
    family.date = run.date;
    family.program = run.program;
    family.taken = run.taken ? taken_words(*run.taken) : "";
    family.figures[row.name] = {row.value, row.spread};
  };
  for (const MeasuredRow& measured : run.rows) {
    keep(measured.row);
    if (const auto cost = cost_row(measured.row)) keep(*cost);
  }
  std::error_code problem;
  fs::create_directories(file.parent_path(), problem);
  if (problem) throw FileError(file.parent_path().string(), 0, "cannot be created: " + problem.message());
  write_text_file(file, to_json(last).dump(1) + "\n");
}

}  // namespace gearshift
