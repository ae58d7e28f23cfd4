// The page shows the measurements and marks the best methods; user text cannot change the markup.
#include "app/lab/bench/bench_page.h"

#include <algorithm>
#include <limits>

#include <doctest/doctest.h>
#include <glm/vec2.hpp>

#include "app/base/colours.h"
#include "app/lab/bench/curve_svg.h"
#include "app/lab/bench/trade_svg.h"
#include "tests/app/lab/bench/constructed_run.h"
#include "tests/app/lessons/report/page_parts.h"

using namespace gearshift::base;
using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

// True if every tag is closed in the right order and all attributes are quoted.
bool is_well_formed(std::string_view page) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = page.find('<', at)) != std::string_view::npos;) {
    const std::size_t end = page.find('>', at);
    if (end == std::string_view::npos) return false;
    const std::string_view tag = page.substr(at + 1, end - at - 1);
    at = end;
    if (tag.empty() || tag.find('<') != std::string_view::npos) return false;
    if (tag.front() == '!' || tag.back() == '/') continue;
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return false;
    if (tag.front() == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return false;
      open.pop_back();
    } else {
      open.emplace_back(tag.substr(0, tag.find(' ')));
    }
  }
  return open.empty();
}

int occurrences(std::string_view text, std::string_view what) {
  int n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string_view::npos; at += what.size()) ++n;
  return n;
}

std::vector<BenchRow> three_walks() {
  return {trade_row("slow", 100.0, 0.1), trade_row("quick", 10.0, 1.0, true), trade_row("beaten", 50.0, 2.0)};
}

}  // namespace

TEST_CASE("the checker itself rejects malformed pages") {
  CHECK(is_well_formed("<!DOCTYPE html><a b=\"1\"><c/></a>"));
  for (const char* bad : {"<a>", "<a></b>", "<a><b></a></b>", "</a>", "<a b=\"1></a>", "<a <b></b></a>"})
    CHECK_FALSE(is_well_formed(bad));
}

TEST_CASE("whatever text rows contain, the page is well-formed and adds no markup from it") {
  BenchRow evil = trade_row("<script>alert(\"1\")</script>", 1.0, 1.0);
  evil.trade->contest = "a < b & \"c\"";
  evil.note = "</td></tr></table>";
  evil.unit = "<b>";
  evil.related = {{"<i>", 1.0, "&"}};
  evil.trade->cost.what = "<u>";
  BenchRow tame = trade_row("plain", 1.0, 1.0);
  tame.related = {{"i", 1.0, "u"}};
  const std::string page = bench_page(make_run({evil}));
  CHECK(is_well_formed(page));
  CHECK(tags_of(page) == tags_of(bench_page(make_run({tame}))));
  CHECK(page.find("<script") == std::string::npos);
}

TEST_CASE("the page needs no other files") {
  const std::string page = bench_page(make_run(three_walks()));
  for (const char* outside : {"src=", "<link", "@import", "<script", "url("})
    CHECK(page.find(outside) == std::string::npos);
}

TEST_CASE("rows, goals and unmeasured values appear in their family's table") {
  BenchRow missed = plain_row("walk", "late", 3.5), reached = plain_row("walk", "early", 1.5);
  missed.goal = reached.goal = 2.0;
  BenchRow absent = plain_row("walk", "absent", 0.0);
  absent.measured = false;
  absent.goal = 2.0;
  const std::string page = bench_page(make_run({missed, reached, absent}));
  const auto rows = table_of(section_of(page, "family-walk"), "figures");
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] == std::vector<std::string>{"late", "3.5 ns", "", "<= 2", "not met", "", ""});
  CHECK(rows[1][4] == "met");
  CHECK(rows[2][1] == "not measured");
  CHECK(rows[2][4].empty());
}

TEST_CASE("every row of the design is on the page, with its answer or a note that this run has none") {
  BenchRow answer = plain_row("walk", "as asked", 1.0);
  answer.design = Design::plant;
  answer.note = "too few for a verdict";
  const auto rows = table_of(section_of(bench_page(make_run({answer})), "design"), "design");
  CHECK(rows.size() == kDesignRows.size() + 2);
  CHECK(std::count_if(rows.begin(), rows.end(), [](const auto& r) { return r.back() == "not in this run"; }) ==
        static_cast<long>(kDesignRows.size()) - 1);
  const auto found = std::find_if(rows.begin(), rows.end(), [](const auto& r) { return r[0] == "walk, as asked"; });
  REQUIRE(rows.end() - found > 1);
  CHECK((*found)[1] == "1 ns");
  CHECK(found[1] == std::vector<std::string>{"too few for a verdict"});
}

TEST_CASE("changes since the last run have a section if there was one") {
  BenchRun run = make_run({plain_row("walk", "a", 1.0), plain_row("walk", "b", 1.0)});
  CHECK(bench_page(run).find("id=\"changes\"") == std::string::npos);
  run.rows[0].since = SinceLast{"2025-01-01T00:00:00Z", "gearshift 9.8", "", 1.0, 1.0, false};
  CHECK(bench_page(run).find("Nothing changed by more than its spread.") != std::string::npos);
  run.rows[1].since = SinceLast{"2025-01-01T00:00:00Z", "gearshift 9.8", "", 2.0, 0.5, true};
  const auto rows = table_of(section_of(bench_page(run), "changes"), "changes");
  REQUIRE(rows.size() == 1);
  CHECK(rows[0] ==
        std::vector<std::string>{"walk, b", "2 ns", "1 ns", "0.5 x *", "2025-01-01T00:00:00Z, gearshift 9.8"});
}

TEST_CASE("a plot: methods on the front are dark, others light; the default is ringed and named") {
  const std::string svg = trade_svg("walk", three_walks());
  CHECK(is_well_formed(svg));
  CHECK(occurrences(svg, "<circle") == 4);  // three dots, and a ring around the default method
  CHECK(occurrences(svg, "fill=\"none\" stroke=\"" + std::string(kGearColour)) == 1);
  CHECK(svg.find("quick (the default)") != std::string::npos);
  CHECK(svg.find("slow (the default)") == std::string::npos);
  const auto dot_of = [&](const std::string& method) {
    const std::size_t title = svg.find("<title>" + method);
    return svg.substr(svg.rfind("<circle", title), title - svg.rfind("<circle", title));
  };
  CHECK(dot_of("slow").find(kInk) != std::string::npos);
  CHECK(dot_of("beaten").find("#a9b4bf") != std::string::npos);
}

TEST_CASE("a front of two is a line with two steps: from the top, down at each, then to the right") {
  const std::string svg = trade_svg("walk", three_walks());
  const std::string_view points = between(svg, "<polyline points=\"", " \"");
  std::vector<glm::dvec2> line;
  for (std::size_t at = 0; at < points.size();) {
    const std::size_t space = std::min(points.find(' ', at), points.size());
    const std::string point(points.substr(at, space - at));
    line.emplace_back(std::stod(point), std::stod(point.substr(point.find(',') + 1)));
    at = space + 1;
  }
  REQUIRE(line.size() == 5);
  for (std::size_t i = 1; i < line.size(); ++i) {
    CHECK((line[i].x == line[i - 1].x || line[i].y == line[i - 1].y));
    CHECK(line[i].x >= line[i - 1].x);
    CHECK(line[i].y >= line[i - 1].y);  // y grows down the page, towards smaller errors
  }
}

TEST_CASE("a non-finite value is not plotted but listed below the plot") {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN(), kEndless = std::numeric_limits<double>::infinity();
  std::vector<BenchRow> rows = three_walks();
  rows.push_back(trade_row("free of charge", kNone, 0.5));
  rows.push_back(trade_row("endless", 20.0, kEndless, true));
  BenchRow wide = trade_row("wide", 30.0, 0.4);
  wide.trade->cost.spread = Quartiles{25.0, kEndless};
  rows.push_back(wide);
  const std::string svg = trade_svg("walk", rows);
  CHECK(is_well_formed(svg));
  for (const char* coordinate : {"=\"nan", "=\"-nan", "=\"inf", "=\"-inf", ",inf", ",nan"}) {
    CAPTURE(coordinate);
    CHECK(svg.find(coordinate) == std::string::npos);
  }
  CHECK(svg.find("<title>free of charge") == std::string::npos);
  CHECK(svg.find("<title>endless") == std::string::npos);
  CHECK(svg.find("<title>wide") != std::string::npos);
  CHECK(svg.find(">free of charge, not in the plot</text>") != std::string::npos);
  CHECK(svg.find(">endless (the default), not in the plot</text>") != std::string::npos);
}

TEST_CASE("no plot for a family without methods, of another family, without measurements, or with a single method") {
  CHECK(trade_svg("walk", {}).empty());
  CHECK(trade_svg("swim", three_walks()).empty());
  CHECK(trade_svg("walk", {plain_row("walk", "a", 1.0)}).empty());
  BenchRow absent = trade_row("absent", 1.0, 1.0);
  absent.measured = false;
  CHECK(trade_svg("walk", {absent}).empty());
  CHECK(trade_svg("walk", {trade_row("alone", 0.0, 0.0)}).empty());
}

TEST_CASE("curves: a row of plots for each row that has some, with every point at its place, also on the page") {
  BenchRow row = plain_row("walk", "on a hill", 1.0);
  row.curves = {{"speed", "effort", {{0.5, 1.0}, {5.0, -1.0}, {50.0, 2.0}}},
                {"speed", "pulse", {{1.0, 0.2}, {10.0, 0.4}}}};
  const std::vector<BenchRow> rows{plain_row("walk", "flat", 1.0), row};
  CHECK(curve_svg("swim", rows).empty());
  CHECK(curve_svg("walk", {rows.front()}).empty());
  const std::string svg = curve_svg("walk", rows);
  CHECK(is_well_formed(svg));
  CHECK(occurrences(svg, "<circle") == 5);
  CHECK(occurrences(svg, "<polyline") == 2);
  for (const char* text : {">on a hill<", ">effort<", ">pulse<"}) CHECK(svg.find(text) != std::string::npos);
  CHECK(svg.find(">flat<") == std::string::npos);
  // The middle of a decade axis is the geometric mean, and lower values are further down.
  const auto x_of = [&](std::size_t from) { return std::stod(svg.substr(svg.find("cx=\"", from) + 4)); };
  const std::size_t first = svg.find("<circle"), second = svg.find("<circle", first + 1),
                    third = svg.find("<circle", second + 1);
  CHECK(x_of(second) == doctest::Approx(0.5 * (x_of(first) + x_of(third))));
  CHECK(std::stod(svg.substr(svg.find("cy=\"", second) + 4)) > std::stod(svg.substr(svg.find("cy=\"", first) + 4)));
  CHECK(bench_page(make_run(rows)).find("<figure id=\"curves-walk\">") != std::string::npos);
}
