#include "app/lab/bench/bench_page.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/lab/bench/curve_svg.h"
#include "app/lab/bench/trade_svg.h"

namespace gearshift::lab {
namespace {

constexpr const char* kBenchStyle = R"css(
html { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
table { font-size: 0.85rem; }
th { vertical-align: bottom; }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.soft { color: #6b7785; }
.met { color: #2e7d4f; font-weight: bold; white-space: nowrap; }
.met span, .missed span { color: #9a6700; font-weight: normal; }
.missed { color: #c5303b; font-weight: bold; white-space: nowrap; }
.changed { background: #fdf3e1; }
table.figures td:first-child { min-width: 15rem; }
table.design tr.ask td { border-top: 2px solid #6b7785; background: #f1f3f6; }
table.design tr.ask td:first-child { font-weight: bold; padding-left: 0.4rem; }
table.design tr.row td:first-child { padding-left: 1.4rem; width: 50%; }
table.design tr.why td { padding-left: 2.8rem; border-top: none; }
figure { margin: 2.2rem 0; }
figcaption { font-size: 1.1rem; font-weight: bold; color: #1f2933; margin-bottom: 0.6rem; }
svg { max-width: 100%; height: auto; }
@media screen and (max-width: 700px) {
  table, figure { display: block; overflow-x: auto; }
  svg { max-width: none; }
}
@media print {
  @page { margin: 12mm; }
  thead { display: table-header-group; }
  table { font-size: 7.5pt; }
  figure { margin: 0.6rem 0; }
}
)css";

std::vector<BenchRow> plain_rows(const BenchRun& run) {
  std::vector<BenchRow> rows;
  for (const MeasuredRow& measured : run.rows) rows.push_back(measured.row);
  return rows;
}

std::vector<std::string> families_of(const BenchRun& run) {
  std::vector<std::string> families;
  for (const MeasuredRow& measured : run.rows) {
    if (std::find(families.begin(), families.end(), measured.row.family) == families.end())
      families.push_back(measured.row.family);
  }
  return families;
}

std::string facts(const BenchRun& run) {
  const auto row = [](std::string_view what, const std::string& value) {
    return value.empty() ? "" : fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", what, base::html_text(value));
  };
  const Machine& m = run.machine;
  return "<table class=\"facts\">\n" + row("Date", run.date) + row("Program", run.program) +
         row("Processor", fmt::format("{}, {} cores", m.cpu, m.cores)) + row("GPU", m.gpu) + row("System", m.system) +
         row("Build", fmt::format("{}, {}", m.build, m.compiler)) +
         row("CPU time used by others", run.contention ? format_contention(*run.contention) : "") +
         row("Run", run.quick ? "quick run; do not quote its figures" : "full") + "</table>\n";
}

std::string verdict_cell(const BenchRow& row) {
  const Verdict verdict = verdict_of(row);
  if (verdict == Verdict::none) return "<td></td>";
  const bool met = verdict == Verdict::met;
  return fmt::format(
      "<td class=\"{}\">{}{}</td>", met ? "met" : "missed", met ? "met" : "not met",
      is_open(row) ? "<br/><span title=\"the quartiles lie on both sides of the goal\">open</span>" : "");
}

std::string format_figure(const BenchRow& row) {
  return row.measured ? fmt::format("{} {}", format_value(row.value), row.unit) : "not measured";
}

std::string number_cell(const std::string& text) {
  return fmt::format("<td class=\"number\">{}</td>", base::html_text(text));
}

// Formats a measured row. If it has no verdict, a second table row shows its note.
std::string answer_row(const BenchRow& row) {
  const bool is_judged = verdict_of(row) != Verdict::none;
  const std::string why = is_judged || row.note.empty() ? ""
                                                        : fmt::format(
                                                              "<tr class=\"why\"><td colspan=\"5\" "
                                                              "class=\"soft\">{}</td></tr>\n",
                                                              base::html_text(row.note));
  return fmt::format("<tr class=\"row\"><td>{}, {}</td>{}{}{}{}</tr>\n", base::html_text(row.family),
                     base::html_text(row.name), number_cell(format_figure(row)), number_cell(format_spread(row.spread)),
                     number_cell(format_goal(row)), verdict_cell(row)) +
         why;
}

// Formats a requirement of the design and the measured rows of this run that answer it.
std::string requirement_rows(const DesignRow& requirement, const BenchRun& run) {
  std::string answers;
  for (const MeasuredRow& measured : run.rows) {
    if (measured.row.design == requirement.key) answers += answer_row(measured.row);
  }
  return fmt::format(
             "<tr class=\"ask\" id=\"design-{}\"><td>{}</td><td colspan=\"3\">{}</td><td "
             "class=\"soft\">{}</td></tr>\n",
             requirement.name, base::html_text(requirement.what), base::html_text(requirement.figure),
             answers.empty() ? "not in this run" : "") +
         answers;
}

std::string design_section(const BenchRun& run) {
  std::string text =
      "<section id=\"design\">\n<h2>Required by the design</h2>\n<table "
      "class=\"design\">\n<thead><tr><th>Requirement</th>"
      "<th class=\"number\">Measured</th><th class=\"number\">Quartiles</th><th "
      "class=\"number\">Goal</th><th></th>"
      "</tr></thead>\n<tbody>\n";
  for (const DesignRow& requirement : kDesignRows) text += requirement_rows(requirement, run);
  return text + "</tbody>\n</table>\n</section>\n";
}

std::string trades_section(const BenchRun& run) {
  std::string figures;
  const std::vector<BenchRow> rows = plain_rows(run);
  for (const std::string& family : families_of(run)) {
    const std::string svg = trade_svg(family, rows);
    if (svg.empty()) continue;
    figures += fmt::format("<figure id=\"trade-{0}\">\n<figcaption>{0}</figcaption>\n{1}</figure>\n",
                           base::html_text(family), svg);
  }
  if (figures.empty()) return {};
  return "<section id=\"trades\">\n<h2>Methods compared</h2>\n<p>Cost increases to the right, error upwards. The line "
         "is the Pareto front: methods on the line are dark, and methods that others beat in both cost and error are "
         "lighter. The default has a ring. Bars show the quartiles.</p>\n" +
         figures + "</section>\n";
}

std::string curves_section(const BenchRun& run) {
  std::string figures;
  const std::vector<BenchRow> rows = plain_rows(run);
  for (const std::string& family : families_of(run)) {
    const std::string svg = curve_svg(family, rows);
    if (svg.empty()) continue;
    figures += fmt::format("<figure id=\"curves-{0}\">\n<figcaption>{0}</figcaption>\n{1}</figure>\n",
                           base::html_text(family), svg);
  }
  return figures.empty() ? "" : "<section id=\"curves\">\n<h2>Curves</h2>\n" + figures + "</section>\n";
}

std::string change_row(const BenchRow& row, const std::optional<SinceLast>& since) {
  if (!since || !since->changed) return {};
  const std::string contention = since->contention.empty() ? "" : fmt::format("; CPU time: {}", since->contention);
  return fmt::format("<tr><td>{}, {}</td>{}{}{}<td>{}</td></tr>\n", base::html_text(row.family),
                     base::html_text(row.name), number_cell(fmt::format("{} {}", format_value(since->value), row.unit)),
                     number_cell(format_figure(row)), number_cell(format_change(since)),
                     base::html_text(fmt::format("{}, {}{}", since->date, since->program, contention)));
}

std::string changes_section(const BenchRun& run) {
  std::string table;
  bool compared = false;
  for (const MeasuredRow& measured : run.rows) {
    compared = compared || measured.since;
    table += change_row(measured.row, measured.since);
    if (const auto cost = cost_row(measured.row)) table += change_row(*cost, measured.cost_since);
  }
  if (!compared) return {};
  const std::string head = "<section id=\"changes\">\n<h2>Changes since the last full run on this machine</h2>\n";
  if (table.empty()) return head + "<p>Nothing changed by more than its spread.</p>\n</section>\n";
  return head +
         "<table class=\"changes\">\n<thead><tr><th>Row</th><th class=\"number\">Then</th><th class=\"number\">Now</th>"
         "<th class=\"number\">Ratio</th><th>Last run</th></tr></thead>\n<tbody>\n" +
         table + "</tbody>\n</table>\n</section>\n";
}

std::string notes_cell(const BenchRow& row) {
  std::string text = base::html_text(row.note);
  for (const RelatedFigure& more : row.related) {
    text += fmt::format("{}{} {} {}", text.empty() ? "" : "; ", base::html_text(more.what), format_value(more.value),
                        base::html_text(more.unit));
  }
  return fmt::format("<td class=\"soft\">{}</td>", text);
}

std::string family_section(const std::string& family, const BenchRun& run) {
  std::string text = fmt::format(
      "<section id=\"family-{0}\">\n<h2>{0}</h2>\n<table class=\"figures\">\n<thead><tr><th>Quantity</th>"
      "<th class=\"number\">Measured</th><th class=\"number\">Quartiles</th><th class=\"number\">Goal</th><th></th>"
      "<th class=\"number\">Since last run</th><th>Notes and related figures</th></tr></thead>\n<tbody>\n",
      base::html_text(family));
  for (const MeasuredRow& measured : run.rows) {
    const BenchRow& row = measured.row;
    if (row.family != family) continue;
    const auto differs = [](const std::optional<SinceLast>& since) { return since && since->changed; };
    const bool changed = differs(measured.since) || differs(measured.cost_since);
    text += fmt::format("<tr{}><td>{}</td>{}{}{}{}{}{}</tr>\n", changed ? " class=\"changed\"" : "",
                        base::html_text(row.name), number_cell(format_figure(row)),
                        number_cell(format_spread(row.spread)), number_cell(format_goal(row)), verdict_cell(row),
                        number_cell(format_change(measured)), notes_cell(row));
  }
  return text + "</tbody>\n</table>\n</section>\n";
}

std::size_t count_of(const BenchRun& run, Verdict verdict) {
  return static_cast<std::size_t>(std::count_if(run.rows.begin(), run.rows.end(), [&](const MeasuredRow& measured) {
    return verdict_of(measured.row) == verdict;
  }));
}

// Formats how many goals are met and lists the missed ones.
std::string summary(const BenchRun& run) {
  const auto needs_mention = [](const BenchRow& row) { return verdict_of(row) == Verdict::missed || is_open(row); };
  const std::size_t met = count_of(run, Verdict::met), goals = met + count_of(run, Verdict::missed);
  if (goals == 0) return {};
  std::string table;
  for (const MeasuredRow& measured : run.rows) {
    const BenchRow& row = measured.row;
    if (!needs_mention(row)) continue;
    table += fmt::format("<tr><td><a href=\"#family-{0}\">{0}</a>, {1}</td>{2}{3}{4}</tr>\n",
                         base::html_text(row.family), base::html_text(row.name), number_cell(format_figure(row)),
                         number_cell(format_goal(row)), verdict_cell(row));
  }
  std::string text = fmt::format("<p id=\"summary\"><b>{} of {} goals are met</b>{}.", met, goals,
                                 run.quick ? " in a quick run, which takes fewer samples than a full run" : "");
  const bool any_open = std::any_of(run.rows.begin(), run.rows.end(), [](const auto& m) { return is_open(m.row); });
  if (any_open)
    text +=
        " \"Open\" means that the goal lies between the measured quartiles, so another run may decide the other way.";
  text += "</p>\n";
  if (table.empty()) return text;
  return text + "<table class=\"figures\">\n<tbody>\n" + table + "</tbody>\n</table>\n";
}

std::string contents(const BenchRun& run) {
  std::string links;
  for (const std::string& family : families_of(run))
    links += fmt::format(" <a href=\"#family-{0}\">{0}</a>", base::html_text(family));
  return "<p>Every row:" + links + "</p>\n";
}

}  // namespace

std::string bench_page(const BenchRun& run) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>Speed against error</title>\n"
      "<style>{}{}</style>\n</head>\n<body>\n<h1>Speed against error</h1>\n",
      base::html_style(), kBenchStyle);
  page += facts(run) + contents(run) + summary(run) + trades_section(run) + curves_section(run) + design_section(run) +
          changes_section(run);
  for (const std::string& family : families_of(run)) page += family_section(family, run);
  return page + "</body>\n</html>\n";
}

}  // namespace gearshift::lab
