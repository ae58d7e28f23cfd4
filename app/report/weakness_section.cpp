#include <algorithm>

#include <fmt/format.h>

#include "app/draw/html.h"
#include "app/report/sections.h"
#include "app/report/weak_spots.h"
#include "app/report/words.h"

namespace gearshift {
namespace {

constexpr double kLongestBar = 7.0;  // [rem]

const char* trend_words(Trend trend) {
  switch (trend) {
    case Trend::falling:
      return "<span class=\"passed\">↓ falling</span>";
    case Trend::rising:
      return "<span class=\"failed\">↑ rising</span>";
    case Trend::unclear:
      return "no clear change";
    case Trend::unknown:
      break;
  }
  return "–";
}

// Before above, lately below, on one scale. Nothing where nothing is compared: that is not 0 times.
std::string bars(const WeakSpot& spot, double most) {
  if (spot.trend == Trend::unknown) return "–";
  const auto bar = [&](const char* kind, double rate) {
    return fmt::format("<span class=\"bar {}\" style=\"width:{:.2f}rem\"></span> {:.1f}", kind,
                       most > 0.0 ? kLongestBar * rate / most : 0.0, rate);
  };
  return bar("earlier", spot.earlier) + "<br>" + bar("lately", spot.lately);
}

// "Slow step" alone says nothing: the newest one is told in full. And what to do about it.
std::string name_words(const WeakSpot& spot) {
  std::string words = html_text(plain_words(fault_key(spot.kind)));
  const auto add = [&](std::string_view line) { words += "<br><span class=\"soft\">" + html_text(line) + "</span>"; };
  if (spot.newest_step) add(fault_sentence(*spot.newest_step));
  add(fault_advice(spot.kind));
  return words;
}

std::string spot_row(const WeakSpot& spot, double most) {
  std::string row = fmt::format("<tr><td>{}</td>", name_words(spot));
  for (std::size_t severity = spot.by_severity.size(); severity-- > 0;) {
    const std::size_t count = spot.by_severity[severity];
    row += fmt::format("<td class=\"number\">{}</td>", count == 0 ? std::string() : std::to_string(count));
  }
  row += fmt::format("<td class=\"number\">{:.1f}</td><td class=\"number\">{:.1f}</td>", spot.points, spot.per_ten);
  return row + fmt::format("<td class=\"bars\">{}</td><td>{}</td></tr>\n", bars(spot, most), trend_words(spot.trend));
}

}  // namespace

std::string weakness_section(const LearnerHistory& history) {
  const Weaknesses found = weaknesses(history);
  if (found.spots.empty()) return section("weaknesses", "Weaknesses", paragraph("No fault was seen in a graded run."));
  double most = 0.0;
  for (const WeakSpot& spot : found.spots) most = std::max({most, spot.earlier, spot.lately});
  std::string table = fmt::format(
      "<table class=\"weaknesses\">\n<caption>Faults in graded runs, {} shifts. Earlier and lately: how many of ten "
      "runs had it, in the first and the second half of each lesson's runs, the middle one of an odd number left out. "
      "Falling or rising: if nothing had changed, chance alone would do that less than one time in twenty. Notes count "
      "in their own column alone.</caption>\n"
      "<thead><tr><th>Fault</th><th class=\"number\">Very severe</th><th class=\"number\">Severe</th>"
      "<th class=\"number\">Minor</th><th class=\"number\">Notes</th><th class=\"number\">Points lost</th>"
      "<th class=\"number\">Per 10 shifts</th><th>Earlier, lately</th><th>Trend</th></tr></thead>\n<tbody>\n",
      found.shifts);
  for (const WeakSpot& spot : found.spots) table += spot_row(spot, most);
  return section("weaknesses", "Weaknesses", table + "</tbody></table>\n");
}

}  // namespace gearshift
