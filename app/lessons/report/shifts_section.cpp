#include <type_traits>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/lessons/report/recorded_svg.h"
#include "app/lessons/report/report_text.h"
#include "app/lessons/report/sections.h"
#include "app/lessons/report/timeline_svg.h"

namespace gearshift::lessons {
namespace {

std::string format_order(const ShiftRecord& shift) {
  if (shift.steps_out_of_place == 0) return "as taught";
  return fmt::format("{} out of order", shift.steps_out_of_place);
}

// Calls visit(field, value) for each figure of a shift that the page shows.
void each_figure(const ShiftRecord& shift, const auto& visit) {
  each_field(shift, [&](const RecordField& field, const auto& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, double>) {
      if (*field.label != '\0') visit(field, value);
    }
  });
}

std::string figures_row(const ShownShift& shown, std::span<const Lesson> lessons) {
  const ShiftRecord& shift = shown.chosen.shift;
  std::string row =
      fmt::format("<tr><td class=\"shift\">{}, shift {}</td><td>{}</td><td>{}</td>", run_link(shown.chosen.run),
                  shift.number + 1, gear_change(shift), base::html_text(lesson_title(lessons, shown.chosen.lesson)));
  const auto number = [&](double value, int digits) {
    row += "<td class=\"number\">" + format_number(value, digits) + "</td>";
  };
  number(shown.chosen.points, 1);
  each_figure(shift, [&](const RecordField& field, double value) { number(value, field.decimals); });
  return row + fmt::format("<td>{}</td></tr>\n", format_order(shift));
}

std::string figures_table(std::span<const ShownShift> shifts, std::span<const Lesson> lessons) {
  std::string table = "<table class=\"shifts\">\n<thead><tr><th>Shift</th><th>Gears</th><th>Lesson</th>";
  const auto head = [&](const char* words) { table += fmt::format("<th class=\"number\">{}</th>", words); };
  head("Points lost");
  each_figure({}, [&](const RecordField& field, double) { head(field.label); });
  table += "<th>Steps</th></tr></thead>\n<tbody>\n";
  for (const ShownShift& shown : shifts) table += figures_row(shown, lessons);
  return table + "</tbody></table>\n";
}

std::string timeline(std::span<const ShownShift> shifts) {
  return "<figure class=\"timeline\">\n" + timeline_svg(shifts) + "</figure>\n";
}

constexpr const char* kMeeting = "engine and gearbox speeds, which the clutch brings together; ";

std::string recording_html(const ShownShift& shown) {
  const std::string name = fmt::format("{}, shift {}, {}", run_link(shown.chosen.run), shown.chosen.shift.number + 1,
                                       gear_change(shown.chosen.shift));
  if (!shown.problem.empty())
    return fmt::format("<p class=\"soft\">{}: recording not available. {}</p>\n", name, base::html_text(shown.problem));
  if (!shown.recorded) return {};
  return fmt::format(
      "<div class=\"recording\">\n<figure class=\"force\">\n{}<figcaption>{}: hand force; {}the shift itself "
      "is shaded</figcaption></figure>\n<figure class=\"path\">\n{}<figcaption>From the ring to the dot: "
      "the displayed lever (purple), where the hand pushed the lever (orange) and the shortest path (dashed "
      "green)</figcaption></figure>\n</div>\n",
      force_svg(*shown.recorded), name, shown.recorded->has_car ? kMeeting : "", path_svg(*shown.recorded));
}

std::string group(std::string_view title, std::span<const ShownShift> shifts, std::span<const Lesson> lessons,
                  std::string_view none) {
  std::string html = fmt::format("<h3>{}</h3>\n", title);
  if (shifts.empty()) return html + paragraph(none);
  html += timeline(shifts) + figures_table(shifts, lessons);
  for (const ShownShift& shown : shifts) html += recording_html(shown);
  return html;
}

}  // namespace

std::string shifts_section(const ShownShifts& shifts, std::span<const Lesson> lessons) {
  return section("shifts", "Shifts",
                 group("Most points lost", shifts.worst, lessons, "No driving errors in graded shifts.") +
                     group("Best shifts", shifts.best, lessons, "No clean shift from gear to gear yet."));
}

}  // namespace gearshift::lessons
