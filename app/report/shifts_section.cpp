#include <fmt/format.h>

#include "app/draw/html.h"
#include "app/report/recorded_svg.h"
#include "app/report/sections.h"
#include "app/report/timeline_svg.h"
#include "app/report/words.h"

namespace gearshift {
namespace {

std::string steps_words(const ShiftRecord& shift) {
  if (shift.steps_out_of_place == 0) return "as taught";
  return fmt::format("{} out of place", shift.steps_out_of_place);
}

std::string figures_row(const ShownShift& shown, std::span<const Lesson> lessons) {
  const ShiftRecord& shift = shown.chosen.shift;
  std::string row =
      fmt::format("<tr><td class=\"shift\">{}, shift {}</td><td>{}</td><td>{}</td>", run_link(shown.chosen.run),
                  shift.number + 1, gear_change(shift), html_text(lesson_title(lessons, shown.chosen.lesson)));
  const auto number = [&](double value, int digits) {
    row += "<td class=\"number\">" + number_words(value, digits) + "</td>";
  };
  number(shown.chosen.points, 1);
  number(shift.clutch_lead, 2);
  number(shift.clutch_lag, 2);
  number(shift.torque_gap, 2);
  number(shift.slip_energy, 0);
  number(shift.jerk_peak, 1);
  number(shift.force_peak, 1);
  number(shift.path_efficiency, 2);
  return row + fmt::format("<td>{}</td></tr>\n", steps_words(shift));
}

std::string figures_table(std::span<const ShownShift> shifts, std::span<const Lesson> lessons) {
  const auto head = [](const char* words) { return fmt::format("<th class=\"number\">{}</th>", words); };
  std::string table = "<table class=\"shifts\">\n<thead><tr><th>Shift</th><th>Gears</th><th>Lesson</th>";
  for (const char* words : {"Points lost", "Clutch before lever [s]", "Clutch after gear [s]", "No drive [s]",
                            "Clutch heat [J]", "Jerk [m/s³]", "Push [N]", "Way / shortest"})
    table += head(words);
  table += "<th>Steps</th></tr></thead>\n<tbody>\n";
  for (const ShownShift& shown : shifts) table += figures_row(shown, lessons);
  return table + "</tbody></table>\n";
}

std::string timeline(std::span<const ShownShift> shifts) {
  return "<figure class=\"timeline\">\n" + timeline_svg(shifts) + "</figure>\n";
}

constexpr const char* kMeeting = "engine and gearbox, which the clutch brings together; ";

std::string recording(const ShownShift& shown) {
  const std::string name = fmt::format("{}, shift {}, {}", run_link(shown.chosen.run), shown.chosen.shift.number + 1,
                                       gear_change(shown.chosen.shift));
  if (!shown.problem.empty())
    return fmt::format("<p class=\"soft\">{}: no recording is shown. {}</p>\n", name, html_text(shown.problem));
  if (!shown.recorded) return {};
  return fmt::format(
      "<div class=\"recording\">\n<figure class=\"force\">\n{}<figcaption>{}: what the hand pushed; {}the shift itself "
      "is shaded</figcaption></figure>\n<figure class=\"path\">\n{}<figcaption>From the ring to the dot: the lever "
      "purple as drawn, orange as the hand pushed it; green, dashed: the shortest way</figcaption></figure>\n</div>\n",
      force_svg(*shown.recorded), name, shown.recorded->has_car ? kMeeting : "", path_svg(*shown.recorded));
}

std::string group(std::string_view title, std::span<const ShownShift> shifts, std::span<const Lesson> lessons,
                  std::string_view none) {
  std::string html = fmt::format("<h3>{}</h3>\n", title);
  if (shifts.empty()) return html + paragraph(none);
  html += timeline(shifts) + figures_table(shifts, lessons);
  for (const ShownShift& shown : shifts) html += recording(shown);
  return html;
}

}  // namespace

std::string shifts_section(const ShownShifts& shifts, std::span<const Lesson> lessons) {
  return section(
      "shifts", "Shifts",
      group("What cost most", shifts.worst, lessons, "No shift of a graded run had a fault.") +
          group("What was done best", shifts.best, lessons, "No shift from gear to gear was without a fault yet."));
}

}  // namespace gearshift
