// gearshift gate: what the gate compiler makes of a layout.
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "app/assets_path.h"
#include "app/draw/gate_svg.h"
#include "app/print_out.h"
#include "app/verbs/gate_report.h"
#include "app/verbs/two_files.h"
#include "app/verbs/verbs.h"
#include "haptics/files/part_file.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift {
namespace {

constexpr const char* kGateHelp =
    "What the gate compiler makes of a layout: aisles, junctions, gears, wall pairs and lockouts, as a table "
    "or JSON, and drawn.";
constexpr const char* kGateExamples =
    "\nExamples:\n"
    "  gearshift gate paper                       the gate of the paper, as a table\n"
    "  gearshift gate dog_leg_five --svg out.svg  draw it as well\n"
    "  gearshift gate my_gate.toml --json         an own layout, for programs\n";

struct GateOptions {
  std::string layout;
  std::string svg;
  bool json = false;
};

GateReport make_report(const std::filesystem::path& layout) {
  GateReport report;
  report.layout = read_gate_layout(layout);
  const YokeGeometry yoke;
  report.gate = compile_gate(report.layout, workspace_half_extent(yoke), yoke.radius);
  report.description = describe_gate(report.gate);
  return report;
}

int show_gate(const GateOptions& options) {
  const std::filesystem::path layout = find_asset("gates", options.layout);
  check_two_files("--svg", "the drawing and the layout", options.svg, layout);
  const GateReport report = make_report(layout);
  if (!options.svg.empty()) {
    write_text_file(options.svg, gate_svg(report.gate, report.description, report.layout.name));
    print_problem("drew {}", options.svg);
  }
  print_out("{}", options.json ? gate_json(report) : gate_table(report));
  return 0;
}

std::string join_names() {
  std::string names;
  for (const auto& name : shipped_names("gates")) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

void add_gate_verb(CLI::App& app, VerbAction& action) {
  const auto options = std::make_shared<GateOptions>();
  CLI::App* verb = app.add_subcommand("gate", kGateHelp);
  verb->footer(kGateExamples);
  verb->add_option("LAYOUT", options->layout, "a layout file, or a shipped one: " + join_names())->required();
  verb->add_flag("--json", options->json, "print JSON instead of the table");
  verb->add_option("--svg", options->svg, "draw the gate into this file, in true proportion")->type_name("FILE");
  verb->callback([options, &action] { action = [options] { return show_gate(*options); }; });
}

}  // namespace gearshift
