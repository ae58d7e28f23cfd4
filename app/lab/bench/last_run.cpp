#include "app/lab/bench/last_run.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "haptics/files/atomic_file.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"
#include "haptics/files/text_file.h"

namespace gearshift::lab {
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
        {"date", family.date}, {"program", family.program}, {"taken", family.contention}, {"figures", figures}};
  }
  return {{"families", families}};
}

// Accepts only the form "2026-01-02T03:04:05Z", because the text is printed unchanged on pages and terminals.
bool is_date(std::string text) {
  for (char& c : text) c = c >= '0' && c <= '9' ? '0' : c;
  return text == "0000-00-00T00:00:00Z";
}

// Throws nlohmann::json exceptions or std::invalid_argument if the JSON is not a saved run.
LastRun from_json(const Json& json) {
  LastRun last;
  for (const auto& [name, family] : json.at("families").items()) {
    LastFamily& into = last[name];
    into.date = family.at("date").get<std::string>();
    if (!is_date(into.date)) throw std::invalid_argument("no date");
    into.program = haptics::printable(family.value("program", ""));
    into.contention = haptics::printable(family.value("taken", ""));
    for (const auto& [row, figure] : family.at("figures").items()) {
      LastFigure& saved = into.figures[row];
      saved.value = figure.at("value").get<double>();
      if (figure.contains("quartiles"))
        saved.spread = Quartiles{figure["quartiles"].at(0).get<double>(), figure["quartiles"].at(1).get<double>()};
    }
  }
  return last;
}

std::string rename_unreadable(const fs::path& file) {
  std::error_code problem;
  fs::path aside = file;
  aside += ".unreadable";
  for (int n = 2; fs::exists(fs::symlink_status(aside, problem)); ++n) {
    aside = file;
    aside += fmt::format(".unreadable{}", n);
  }
  fs::rename(file, aside, problem);
  return problem ? "the file could not be renamed (" + problem.message() + ")"
                 : "the file was renamed to " + aside.string();
}

// True if the values differ in the four digits that the table prints.
bool differs_as_shown(double a, double b) {
  return format_value(a) != format_value(b);
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

LastRun read_last_run(const fs::path& file, const std::function<void(const std::string&)>& report) {
  std::error_code unknown;
  if (fs::symlink_status(file, unknown).type() == fs::file_type::not_found) return {};
  std::string problem;
  try {
    return from_json(Json::parse(haptics::read_text_file(file)));
  } catch (const haptics::FileError& error) {
    problem = error.what();
  } catch (const std::exception&) {
    problem = file.string() + ": this is not a saved bench run";
  }
  report(fmt::format("{}, so this run is not compared with the last one; {}", problem, rename_unreadable(file)));
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
                   .contention = family->second.contention,
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

void save_run(const fs::path& file, LastRun last, const BenchRun& run) {
  const auto is_saved = [](const BenchRow& row) { return row.measured && std::isfinite(row.value); };
  for (const MeasuredRow& measured : run.rows) {
    if (is_saved(measured.row)) last.erase(measured.row.family);
  }
  const auto save = [&](const BenchRow& row) {
    if (!is_saved(row)) return;
    LastFamily& family = last[row.family];
    family.date = run.date;
    family.program = run.program;
    family.contention = run.contention ? format_contention(*run.contention) : "";
    family.figures[row.name] = {row.value, row.spread};
  };
  for (const MeasuredRow& measured : run.rows) {
    save(measured.row);
    if (const auto cost = cost_row(measured.row)) save(*cost);
  }
  std::error_code problem;
  fs::create_directories(file.parent_path(), problem);
  if (problem)
    throw haptics::FileError(file.parent_path().string(), 0, "cannot be created (" + problem.message() + ")");
  haptics::write_text_file(file, to_json(last).dump(1) + "\n");
}

}  // namespace gearshift::lab
