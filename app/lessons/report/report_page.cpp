#include "app/lessons/report/report_page.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/base/program_name.h"
#include "app/lessons/report/sections.h"

namespace gearshift::lessons {
namespace {

constexpr const char* kStyle = R"css(
html { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
body { overflow-wrap: anywhere; }
th, dd, dt { overflow-wrap: normal; }
h1 { margin-bottom: 0; }
h3 { font-size: 1.05rem; margin: 1.8rem 0 0.4rem; }
svg { display: block; width: 100%; height: auto; }
.soft { color: #6b7785; }
dl.totals { display: flex; flex-wrap: wrap; margin: 1.4rem 0; }
dl.totals div { padding-right: 1.6rem; margin-right: 1.6rem; border-right: 1px solid #d5dbe1; }
dl.totals div:last-child { border: 0; }
dl.totals dt { color: #6b7785; font-size: 0.85rem; }
dl.totals dd { margin: 0; font-size: 1.7rem; font-weight: bold; line-height: 1.2; }
p.next { border-left: 0.35rem solid #1f5fa8; background: #eef4fa; padding: 0.8rem 1.1rem; margin: 1.4rem 0; }
.curves { display: flex; flex-wrap: wrap; justify-content: space-between; }
.curves figure { width: 48%; margin: 0.8rem 0; }
.recording { display: flex; flex-wrap: wrap; align-items: flex-start; justify-content: space-between; }
.recording figure { margin: 0.4rem 0 1.2rem; }
.recording figure.force { width: 64%; }
.recording figure.path { width: 32%; }
th { vertical-align: bottom; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
td.number, td.shift, td.day, td.bars { white-space: nowrap; }
table.tasks, table.kept { width: auto; }
table.class th, table.class td { padding-right: 1.4rem; }
table.class td:first-child { white-space: nowrap; }
table.class td:last-child { width: 45%; }
.learner p.next { padding: 0.4rem 1.1rem; margin: 0.6rem 0; }
table.standings { table-layout: fixed; }
table.standings th:first-child, table.standings td:first-child { width: 19%; }
table.standings th:nth-child(2), table.standings td:nth-child(2) { width: 9%; }
table.standings th:last-child, table.standings td:last-child { width: 32%; }
.can { color: #2e7d4f; font-weight: bold; }
.nearly { color: #1f5fa8; font-weight: bold; }
.not_yet { color: #c5303b; font-weight: bold; }
.not_tried { color: #6b7785; }
table.kept th, table.kept td, table.tasks th, table.tasks td { padding-right: 1.4rem; }
table.weaknesses th, table.weaknesses td { padding-right: 1.2rem; }
table.weaknesses th:first-child { width: 34%; }
table.weaknesses th:last-child { width: 15%; }
table.shifts { font-size: 0.85rem; }
table.few th { font-weight: normal; color: #6b7785; white-space: nowrap; }
table.few td { width: 100%; }
table.few li { display: inline-block; margin-right: 1.6rem; }
td ul { margin: 0; padding-left: 0; list-style: none; }
td blockquote { margin: 0.3rem 0; padding-left: 0.6rem; border-left: 0.2rem solid #1f5fa8; white-space: pre-line; }
.passed { color: #2e7d4f; font-weight: bold; }
.failed { color: #c5303b; font-weight: bold; }
.bar { display: inline-block; height: 0.6rem; background: #1f5fa8; border-radius: 1px; }
.bar.earlier { background: #b9cbe0; }
table.runs { font-size: 0.85rem; }
table.runs th:nth-child(3) { width: 17%; }
table.runs th:nth-child(6) { width: 18%; }
table.runs th:nth-child(7) { width: 49%; }
table.runs tr:target { background: #fdf3e1; }
@media screen and (max-width: 50rem) { .curves figure, .recording figure.force, .recording figure.path { width: 100%; } }
@media print {
  @page { margin: 14mm 12mm; }
  thead { display: table-header-group; }
  p, li, td { orphans: 3; widows: 3; }
  caption, thead, p.lead { break-inside: avoid; break-after: avoid; }
  tbody tr:first-child, tbody tr:last-child, table + p.soft { break-before: avoid; }
  table, table.shifts, table.runs { font-size: 8pt; }
  td, th { padding: 0.25rem 0.5rem 0.25rem 0; }
  table.weaknesses th, table.weaknesses td { padding-right: 0.7rem; }
  .learner, .recording, p.soft, table.tasks, table.few, table.kept, table.shifts { break-inside: avoid; }
  figcaption { font-size: 8pt; }
  h2 { margin-top: 1.2rem; padding-top: 0.6rem; }
  dl.totals, p.next { margin: 0.8rem 0; }
  table { margin: 0.6rem 0; }
  .curves figure { margin: 0.3rem 0; }
  .recording figure { margin: 0.2rem 0 0.4rem; }
  .recording figure.force { width: 54%; }
  .recording figure.path { width: 27%; }
  a { color: inherit; text-decoration: none; }
  h3 { break-after: avoid; }
}
)css";

ShownShift show_shift(const ChosenShift& chosen, const std::filesystem::path& folder) {
  ShownShift shift{chosen, {}, {}};
  if (chosen.recording.empty()) return shift;
  try {
    // If the recording's path is absolute, operator/ ignores `folder`.
    shift.recorded = read_shift(folder / chosen.recording, chosen.shift);
  } catch (const std::exception& problem) {
    shift.problem = problem.what();
  }
  return shift;
}

}  // namespace

ShownShifts show_shifts(const LearnerHistory& history, const std::filesystem::path& folder) {
  const ChosenShifts chosen = choose_shifts(history);
  ShownShifts shifts;
  for (const ChosenShift& worst : chosen.worst) shifts.worst.push_back(show_shift(worst, folder));
  for (const ChosenShift& best : chosen.best) shifts.best.push_back(show_shift(best, folder));
  return shifts;
}

std::string section(std::string_view id, std::string_view title, const std::string& html) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, html);
}

std::string paragraph(std::string_view text) {
  return fmt::format("<p>{}</p>\n", base::html_text(text));
}

std::string run_link(std::int64_t run) {
  return fmt::format("<a href=\"#run-{0}\">Run {0}</a>", run);
}

std::string page_begin(std::string_view title) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>{}{}</style>\n</head>\n<body>\n",
      base::html_text(title), base::html_style(), kStyle);
}

std::string page_end() {
  return fmt::format(
      "<p class=\"soft\">{}. Dates and times are UTC. Grades range from 0 to 10; guided runs are not graded.</p>\n"
      "</body>\n</html>\n",
      base::html_text(base::program_name()));
}

std::string report_page(const LearnerHistory& history, const ShownShifts& shifts, std::span<const Lesson> lessons) {
  return page_begin(history.learner.name + ": driving report") + head_section(history, lessons) +
         standing_section(history, lessons) + progress_section(history, lessons) + weakness_section(history) +
         shifts_section(shifts, lessons) + runs_section(history, lessons) + page_end();
}

}  // namespace gearshift::lessons
