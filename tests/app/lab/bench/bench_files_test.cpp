// The formatted files contain the run's data, as read by independent parsers.
#include "app/lab/bench/bench_files.h"

#include <limits>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/app/lab/bench/constructed_run.h"

using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

// Parses CSV as in RFC 4180, but lines end with LF.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i + 1 < text.size() || (i < text.size() && text[i] != '\n'); ++i) {
    const char c = text[i];
    if (c == '"' && quoted && text[i + 1] == '"') {
      lines.back().back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      lines.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      lines.push_back({""});
    } else {
      lines.back().back() += c;
    }
  }
  return lines;
}

BenchRow full_row() {
  BenchRow row = trade_row("a \"good\" one, cheap", 3.0, 0.125, true);
  row.goal = 0.25;
  row.spread = Quartiles{0.1, 0.2};
  row.related = {{"cost", 3.0, "ns"}};
  row.design = Design::plant;
  return row;
}

BenchRow row_not_measured() {
  BenchRow row = plain_row("walk", "out of reach", 0.0);
  row.measured = false;
  row.goal = 1.0;
  row.note = "not measurable: no path";
  return row;
}

}  // namespace

TEST_CASE("CSV: each line has as many fields as the header, and text comes back unchanged") {
  BenchRun run = make_run({full_row(), row_not_measured()});
  run.rows[0].since = SinceLast{"2025-01-01T00:00:00Z", "gearshift 9.8", "", 0.5, 0.25, true};
  const auto lines = parse_csv(bench_csv(run));
  REQUIRE(lines.size() == 3);
  for (const auto& line : lines) CHECK(line.size() == lines[0].size());
  CHECK(lines[1] == std::vector<std::string>{"walk",
                                             "a \"good\" one, cheap",
                                             "0.125",
                                             "mm",
                                             "0.25",
                                             "at most",
                                             "met",
                                             "plant",
                                             "by hand",
                                             "cost = 3 ns",
                                             "0.1",
                                             "0.2",
                                             "walks",
                                             "a \"good\" one, cheap",
                                             "3",
                                             "ns",
                                             "0.125",
                                             "mm",
                                             "yes",
                                             "0.5",
                                             "gearshift 9.9",
                                             "2026-01-02T03:04:05Z"});
  CHECK(lines[2][2].empty());
  CHECK(lines[2][4] == "1");
  CHECK(lines[2][6].empty());
  CHECK(lines[2][8] == "not measurable: no path");
}

TEST_CASE("only the CSV contains a goal's direction and its result") {
  BenchRow slow = plain_row("walk", "slow", 1.0);
  slow.goal = 2.0;
  slow.at_least = true;
  const auto lines = parse_csv(bench_csv(make_run({slow, plain_row("walk", "free", 1.0)})));
  CHECK(std::vector<std::string>(lines[0].begin() + 4, lines[0].begin() + 8) ==
        std::vector<std::string>{"goal", "goal_is", "verdict", "design"});
  CHECK(std::vector<std::string>(lines[1].begin() + 4, lines[1].begin() + 8) ==
        std::vector<std::string>{"2", "at least", "NOT MET", ""});
  CHECK(std::vector<std::string>(lines[2].begin() + 4, lines[2].begin() + 8) == std::vector<std::string>(4));
}

TEST_CASE("JSON: every field comes back; a value that was not measured is null, neither met nor missed") {
  BenchRun run = make_run({full_row(), row_not_measured()});
  run.rows[0].since = SinceLast{"2025-01-01T00:00:00Z", "gearshift 9.8", "", 0.5, 0.25, true};
  run.contention = CpuContention{.by_host = 0.25, .by_programs = 0.0};
  const auto json = nlohmann::json::parse(bench_json(run));
  CHECK(json["program"] == "gearshift 9.9");
  CHECK(json["date"] == "2026-01-02T03:04:05Z");
  CHECK(json["quick"] == false);
  CHECK(json["machine"]["cpu"] == "Abacus");
  CHECK_FALSE(json["machine"].contains("host"));
  CHECK(json["taken"]["by_host"] == 0.25);
  const auto& row = json["rows"][0];
  CHECK(row["value"] == 0.125);
  CHECK(row["quartiles"] == nlohmann::json{0.1, 0.2});
  CHECK(row["verdict"] == "met");
  CHECK(row["design"] == "plant");
  CHECK(row["trade"]["chosen"] == true);
  CHECK(row["trade"]["cost"]["value"] == 3.0);
  CHECK(row["last"]["ratio"] == 0.25);
  CHECK(row["last"]["changed"] == true);
  CHECK(json["rows"][1]["value"].is_null());
  CHECK_FALSE(json["rows"][1].contains("verdict"));
}

TEST_CASE("JSON: a non-finite value is null, and the file stays valid JSON") {
  const BenchRun run = make_run({plain_row("walk", "endless", std::numeric_limits<double>::infinity())});
  CHECK(nlohmann::json::parse(bench_json(run))["rows"][0]["value"].is_null());
}

TEST_CASE("table: the column against the last run appears only if there was one") {
  BenchRun run = make_run({full_row()});
  CHECK(bench_table(run).find("since last") == std::string::npos);
  CHECK(bench_table(run).find("quartiles 0.1 to 0.2") != std::string::npos);
  run.rows[0].since = SinceLast{"2025-01-01T00:00:00Z", "gearshift 9.8", "", 0.5, 0.25, true};
  CHECK(bench_table(run).find("since last") != std::string::npos);
  CHECK(bench_table(run).find("0.25 x *") != std::string::npos);
}

TEST_CASE("a goal is met at exactly its value, from either side") {
  BenchRow row = plain_row("walk", "a", 1.0);
  CHECK(format_verdict(row).empty());
  row.goal = 1.0;
  CHECK(format_verdict(row) == "met");
  row.value = 1.0001;
  CHECK(format_verdict(row) == "NOT MET");
  row.at_least = true;
  CHECK(format_verdict(row) == "met");
  CHECK(format_goal(row) == ">= 1");
}

TEST_CASE("the median decides; a goal between the quartiles is also marked open, at a quartile it is not") {
  BenchRow row = plain_row("walk", "a", 1.0);
  row.goal = 1.1;
  row.spread = Quartiles{0.9, 1.2};
  CHECK(format_verdict(row) == "met (open)");
  row.value = 1.15;
  CHECK(format_verdict(row) == "NOT MET (open)");
  row.spread = Quartiles{0.9, 1.1};
  row.value = 1.0;
  CHECK(format_verdict(row) == "met");
  row.spread = Quartiles{1.15, 1.2};
  row.value = 1.18;
  CHECK(format_verdict(row) == "NOT MET");
}
