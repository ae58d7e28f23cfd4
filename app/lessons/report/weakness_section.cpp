#include <algorithm>
#include <span>
#include <string>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/sections.h"
#include "app/lessons/report/weak_spots.h"

namespace gearshift::lessons {
namespace {

constexpr double kMaxBarWidth = 7.0;  // [rem]

std::string clean_runs(const WeakSpot& spot) {
  return fmt::format("none in the last {} runs", spot.clean);
}

std::string trend_label(const WeakSpot& spot) {
  switch (spot.trend) {
    case Trend::gone:
      return "<span class=\"passed\">gone: " + clean_runs(spot) + "</span>";
    case Trend::falling:
      return "<span class=\"passed\">↓ falling</span>";
    case Trend::rising:
      return "<span class=\"failed\">↑ rising</span>";
    case Trend::unclear:
      return spot.clean > 1 ? clean_runs(spot) : "no clear change";
    case Trend::unknown:
      break;
  }
  return "–";
}

// Names the errors that became rarer; empty if there are none.
std::string improvements(std::span<const WeakSpot> spots) {
  std::string list;
  for (const WeakSpot& spot : spots) {
    std::string change;
    if (spot.trend == Trend::gone)
      change = fmt::format("{} earlier, {}", spot.graded, clean_runs(spot));
    else if (spot.trend == Trend::falling)
      change = fmt::format("in {:.1f} of ten runs earlier, in {:.1f} lately", spot.earlier, spot.recent);
    else
      continue;
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", words_from_key(to_string(spot.kind)), change);
  }
  return list.empty() ? list : fmt::format("<p class=\"lead\">Improved: {}.</p>\n", list);
}

// Draws two bars on one scale: the earlier rate on top, the recent rate below. Draws a dash, not 0, if no runs were
// compared.
std::string bars(const WeakSpot& spot, double max_rate) {
  if (spot.trend == Trend::unknown) return "–";
  const auto bar = [&](const char* kind, double rate) {
    return fmt::format("<span class=\"bar {}\" style=\"width:{:.2f}rem\"></span> {:.1f}", kind,
                       max_rate > 0.0 ? kMaxBarWidth * rate / max_rate : 0.0, rate);
  };
  return bar("earlier", spot.earlier) + "<br>" + bar("recently", spot.recent);
}

// Returns the HTML of the error's name, the newest error's sentence if it names a step, and the advice. The sentence is
// needed because the name "Slow step" does not say which step.
std::string format_spot_name(const WeakSpot& spot) {
  std::string words = base::html_text(title_from_key(to_string(spot.kind)));
  const auto add = [&](std::string_view line) {
    words += "<br><span class=\"soft\">" + base::html_text(line) + "</span>";
  };
  if (spot.newest_step) add(error_sentence(*spot.newest_step));
  add(error_advice(spot.kind));
  return words;
}

std::string spot_row(const WeakSpot& spot, double max_rate) {
  std::string row = fmt::format("<tr><td>{}</td>", format_spot_name(spot));
  for (std::size_t severity = spot.by_severity.size(); severity-- > 0;) {
    const std::size_t count = spot.by_severity[severity];
    row += fmt::format("<td class=\"number\">{}</td>", count == 0 ? std::string() : std::to_string(count));
  }
  row += fmt::format("<td class=\"number\">{:.1f}</td><td class=\"number\">{:.1f}</td>", spot.points, spot.per_ten);
  return row + fmt::format("<td class=\"bars\">{}</td><td>{}</td></tr>\n", bars(spot, max_rate), trend_label(spot));
}

std::string how_to_read(std::size_t shifts) {
  return fmt::format(
      "<p class=\"soft\">Driving errors in all runs ({} shifts), those with guidance and those given up included; "
      "points "
      "and trends come from graded runs. The bars show in how many of ten runs the error occurred, in the first and "
      "the "
      "second half of each lesson's runs; with an odd number of runs, the middle one is left out. A trend is named if "
      "chance alone would cause it less than one time in twenty. Notes are counted only in their own column.</p>\n",
      shifts);
}

}  // namespace

std::string weakness_section(const LearnerHistory& history) {
  const Weaknesses found = weaknesses(history);
  if (found.spots.empty()) return section("weaknesses", "Weaknesses", paragraph("No driving errors."));
  double max_rate = 0.0;
  for (const WeakSpot& spot : found.spots) max_rate = std::max({max_rate, spot.earlier, spot.recent});
  std::string table =
      "<table class=\"weaknesses\">\n<thead><tr><th>Error</th><th class=\"number\">Very severe</th><th "
      "class=\"number\">Severe</th>"
      "<th class=\"number\">Minor</th><th class=\"number\">Notes</th><th class=\"number\">Points lost</th>"
      "<th class=\"number\">Per 10 shifts</th><th>Earlier, recently</th><th>Trend</th></tr></thead>\n<tbody>\n";
  for (const WeakSpot& spot : found.spots) table += spot_row(spot, max_rate);
  return section("weaknesses", "Weaknesses",
                 improvements(found.spots) + table + "</tbody></table>\n" + how_to_read(found.shifts));
}

}  // namespace gearshift::lessons
