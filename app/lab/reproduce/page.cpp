#include "app/lab/reproduce/page.h"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "app/base/html.h"
#include "app/base/program_name.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/files/atomic_file.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::lab {
namespace {

std::string table_row(std::string_view tag, const std::vector<std::string>& cells) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, base::html_text(cell));
  return row + "</tr>\n";
}

std::string link_if_there(const Study& study, const std::string& file, std::string_view label) {
  if (!std::filesystem::exists(study.folder / file)) return {};
  return fmt::format(" <a href=\"{}\">{}</a>", base::html_text(file), label);
}

std::string contents(const std::vector<Section>& sections) {
  std::string list = "<nav><ol>\n";
  for (const Section& section : sections) {
    list +=
        fmt::format("<li><a href=\"#{}\">{}</a></li>\n", base::html_text(section.id), base::html_text(section.title));
  }
  return list + "</ol></nav>\n";
}

std::string format_axis(const haptics::AxisModel& axis) {
  return fmt::format("m {:g} kg, b {:g} N s/m, k {:g} N/m", axis.mass, axis.damping, axis.stiffness);
}

std::string describe_device(const haptics::DeviceSpec& device) {
  return fmt::format("{:g} N peak, {:g} N continuous; encoder resolution {:.1f} um at the tip; delay {} cycle{}",
                     device.max_force.x, device.continuous_force.x, 1e6 * device.position_step, device.delay,
                     device.delay == 1 ? "" : "s");
}

std::string format_tuning(const haptics::AdmittedTuning& admitted) {
  const haptics::HapticTuning& t = admitted.tuning;
  return fmt::format(
      "walls: {:g} N/m, {:g} N s/m, {}; aisles: {:g} N s/m; above {:g} m/s: {:g} N s/m; gate forces scaled by {:g}",
      t.wall_stiffness, t.wall_damping, haptics::to_string(admitted.hold), t.aisle_damping, t.speed_limit,
      t.limit_damping, t.feel_scale);
}

// Formats the configuration with which all sections were computed.
std::string configuration(const Study& study) {
  const auto row = [](std::string_view what, const std::string& value) {
    return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", what, base::html_text(value));
  };
  std::string table =
      "<table class=\"facts\">\n" + row("Preset", study.preset.name) +
      row("Axis X, select", format_axis(study.device.axis_x)) + row("Axis Y, shift", format_axis(study.device.axis_y)) +
      row("Device", describe_device(study.device)) + row("Cycle", fmt::format("{:g} Hz", study.preset.haptics.rate)) +
      row("Tuning in use", format_tuning(study.admitted)) + row("Gate", study.layout.name);
  if (study.preset.haptics.contact.allow_unstable)
    table += row("Unstable values", "allowed (study = true); only for simulated levers");
  for (const haptics::TuningLimit& limited : study.admitted.limits) table += row("Limited", haptics::describe(limited));
  if (study.admitted.limits.empty()) table += row("Limited", "nothing; the preset's tuning is used unchanged");
  return table + "</table>\n";
}

std::string findings_table(const std::vector<Finding>& findings) {
  if (findings.empty()) return {};
  std::string table = "<table class=\"findings\">\n" + table_row("th", {"Paper", "gearshift", "Difference"});
  for (const Finding& finding : findings) table += table_row("td", {finding.paper, finding.result, finding.difference});
  return table + "</table>\n";
}

std::string plain_table(const Study& study, const Table& table) {
  if (table.rows.empty()) return {};
  std::string text = fmt::format("<table>\n<caption>{}{}</caption>\n", base::html_text(table.caption),
                                 link_if_there(study, table.name + ".csv", "CSV"));
  for (std::size_t i = 0; i < table.rows.size(); ++i) text += table_row(i == 0 ? "th" : "td", table.rows[i]);
  return text + "</table>\n";
}

std::string picture_figure(const Study& study, const Picture& picture) {
  const std::string& data = picture.data.empty() ? picture.name : picture.data;
  return fmt::format("<figure><img src=\"{0}.svg\" alt=\"{1}\">\n<figcaption>{1}{2}{3}{4}</figcaption></figure>\n",
                     base::html_text(picture.name), base::html_text(picture.caption),
                     link_if_there(study, picture.name + ".svg", "SVG"),
                     link_if_there(study, picture.name + ".png", "PNG"), link_if_there(study, data + ".csv", "CSV"));
}

std::string section_text(const Study& study, const Section& section) {
  std::string text = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<p>{}</p>\n", base::html_text(section.id),
                                 base::html_text(section.title), base::html_text(section.text));
  if (!section.problem.empty())
    text += fmt::format("<p><strong>Failed: {}</strong></p>\n", base::html_text(section.problem));
  text += findings_table(section.findings) + plain_table(study, section.table);
  for (const Picture& picture : section.pictures) text += picture_figure(study, picture);
  return text + "</section>\n";
}

constexpr const char* kIntroduction =
    "W.-C. Lin, K.-Y. Young, “Design of Force-Reflection Joystick System for VR-Based Simulation”, section by "
    "section: the paper's statement, the result of this program, and the difference. All results are computed from the "
    "preset below, and all motion is simulated with the same haptic cycle as in the trainer. The SVG, PNG and CSV "
    "files "
    "are in the folder of this page.";

}  // namespace

void write_page(const Study& study, const std::vector<Section>& sections) {
  std::string text =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>The paper, "
      "reproduced</title>\n<style>";
  text += base::html_style();
  text += "</style>\n</head>\n<body>\n<h1>The paper, reproduced</h1>\n<p>";
  text += kIntroduction;
  text += "</p>\n" + configuration(study) + contents(sections);
  for (const Section& section : sections) text += section_text(study, section);
  text += "<p>" + base::program_name() + "</p>\n</body>\n</html>\n";
  haptics::write_text_file(study.folder / "index.html", text);
}

}  // namespace gearshift::lab
