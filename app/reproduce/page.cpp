#include "app/reproduce/page.h"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "app/draw/html.h"
#include "app/hold_words.h"
#include "app/limited_words.h"
#include "app/program_name.h"
#include "haptics/files/part_file.h"

namespace gearshift {
namespace {

std::string table_row(std::string_view tag, const std::vector<std::string>& cells) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, html_text(cell));
  return row + "</tr>\n";
}

std::string link_if_there(const Study& study, const std::string& file, std::string_view words) {
  if (!std::filesystem::exists(study.folder / file)) return {};
  return fmt::format(" <a href=\"{}\">{}</a>", html_text(file), words);
}

std::string contents(const std::vector<Section>& sections) {
  std::string list = "<nav><ol>\n";
  for (const Section& section : sections) {
    list += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", html_text(section.id), html_text(section.title));
  }
  return list + "</ol></nav>\n";
}

std::string axis_words(const AxisModel& axis) {
  return fmt::format("m {:g} kg, b {:g} N s/m, k {:g} N/m", axis.mass, axis.damping, axis.stiffness);
}

std::string device_words(const DeviceSpec& device) {
  return fmt::format("{:g} N peak, {:g} N for ever; {:.1f} um of encoder at the tip; {} cycles of delay",
                     device.max_force.x, device.continuous_force.x, 1e6 * device.position_step, device.delay);
}

std::string tuning_words(const AdmittedTuning& admitted) {
  const HapticTuning& t = admitted.tuning;
  return fmt::format("wall {:g} N/m and {:g} N s/m by {}; aisles {:g} N s/m, above {:g} m/s {:g} N s/m; feel x {:g}",
                     t.wall_stiffness, t.wall_damping, hold_words(admitted.hold), t.aisle_damping, t.speed_limit,
                     t.limit_damping, t.feel_scale);
}

// What was run: all of it from the one preset.
std::string configuration(const Study& study) {
  const auto row = [](std::string_view what, const std::string& value) {
    return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", what, html_text(value));
  };
  std::string table =
      "<table class=\"facts\">\n" + row("Preset", study.preset.name) +
      row("Axis X, select", axis_words(study.device.axis_x)) + row("Axis Y, shift", axis_words(study.device.axis_y)) +
      row("Device", device_words(study.device)) + row("Cycle", fmt::format("{:g} Hz", study.preset.haptics.rate)) +
      row("Tuning in use", tuning_words(study.admitted)) + row("Gate", study.layout.name);
  if (study.preset.haptics.contact.study)
    table += row("Study", "nothing is limited to what is stable: simulated levers only");
  for (const Limited& limited : study.admitted.limited) table += row("Limited", limited_words(limited));
  if (study.admitted.limited.empty())
    table += row("Limited", "nothing: the device admits the preset's tuning as it is");
  return table + "</table>\n";
}

std::string findings_table(const std::vector<Finding>& findings) {
  if (findings.empty()) return {};
  std::string table = "<table class=\"findings\">\n" + table_row("th", {"The paper says", "Here", "Difference"});
  for (const Finding& finding : findings) table += table_row("td", {finding.paper, finding.ours, finding.difference});
  return table + "</table>\n";
}

std::string plain_table(const Study& study, const Table& table) {
  if (table.rows.empty()) return {};
  std::string text = fmt::format("<table>\n<caption>{}{}</caption>\n", html_text(table.caption),
                                 link_if_there(study, table.name + ".csv", "CSV"));
  for (std::size_t i = 0; i < table.rows.size(); ++i) text += table_row(i == 0 ? "th" : "td", table.rows[i]);
  return text + "</table>\n";
}

std::string picture_figure(const Study& study, const Picture& picture) {
  const std::string& data = picture.data.empty() ? picture.name : picture.data;
  return fmt::format("<figure><img src=\"{0}.svg\" alt=\"{1}\">\n<figcaption>{1}{2}{3}{4}</figcaption></figure>\n",
                     html_text(picture.name), html_text(picture.caption),
                     link_if_there(study, picture.name + ".svg", "SVG"),
                     link_if_there(study, picture.name + ".png", "PNG"), link_if_there(study, data + ".csv", "CSV"));
}

std::string section_text(const Study& study, const Section& section) {
  std::string text = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<p>{}</p>\n", html_text(section.id),
                                 html_text(section.title), html_text(section.text));
  if (!section.problem.empty())
    text += fmt::format("<p><strong>Not made: {}</strong></p>\n", html_text(section.problem));
  text += findings_table(section.findings) + plain_table(study, section.table);
  for (const Picture& picture : section.pictures) text += picture_figure(study, picture);
  return text + "</section>\n";
}

constexpr const char* kIntroduction =
    "W.-C. Lin, K.-Y. Young, “Design of Force-Reflection Joystick System for VR-Based Simulation”, section by "
    "section: what it says, what this program gives, and how far apart the two are. Every figure is computed from the "
    "preset "
    "below; what moves, moves through the shipped haptic cycle on a simulated lever. SVG, PNG and CSV lie beside this "
    "page.";

}  // namespace

void write_page(const Study& study, const std::vector<Section>& sections) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>The paper, "
      "reproduced</title>\n<style>";
  text += html_style();
  text += "</style>\n</head>\n<body>\n<h1>The paper, reproduced</h1>\n<p>";
  text += kIntroduction;
  text += "</p>\n" + configuration(study) + contents(sections);
  for (const Section& section : sections) text += section_text(study, section);
  text += "<p>" + program_name() + "</p>\n</body>\n</html>\n";
  write_text_file(study.folder / "index.html", text);
}

}  // namespace gearshift
