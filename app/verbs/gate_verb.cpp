// gearshift gate: compiles a layout file and shows the resulting gate.
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/lab/gate/gate_report.h"
#include "app/lab/gate/gate_svg.h"
#include "app/verbs/distinct_outputs.h"
#include "app/verbs/verbs.h"
#include "haptics/files/atomic_file.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::verbs {
namespace {

constexpr const char* kGateHelp =
    "Show the aisles, junctions, gears, wall pairs and lockouts of a gate layout as a table, JSON or drawing.";
constexpr const char* kGateExamples =
    "\nExamples:\n"
    "  gearshift gate paper                       the gate of the paper, as a table\n"
    "  gearshift gate dog_leg_five --svg out.svg  also draw it\n"
    "  gearshift gate my_gate.toml --json         your own layout, as JSON\n";

struct GateOptions {
  std::string layout;
  std::string svg;
  bool json = false;
};

lab::GateReport make_report(const std::filesystem::path& layout) {
  lab::GateReport report;
  report.layout = haptics::read_gate_layout(layout);
  const haptics::YokeGeometry yoke;
  report.gate = haptics::compile_gate(report.layout, haptics::workspace_half_extent(yoke), yoke.radius);
  report.description = haptics::describe_gate(report.gate);
  return report;
}

int show_gate(const GateOptions& options) {
  const std::filesystem::path layout = base::find_asset("gates", options.layout);
  check_distinct_outputs("--svg", "the drawing and the layout", options.svg, layout);
  const lab::GateReport report = make_report(layout);
  if (!options.svg.empty()) {
    haptics::write_text_file(options.svg, lab::gate_svg(report.gate, report.description, report.layout.name));
    base::print_message("wrote {}", options.svg);
  }
  base::print_out("{}", options.json ? lab::gate_json(report) : lab::gate_table(report));
  return 0;
}

std::string join_names() {
  std::string names;
  for (const auto& name : base::shipped_names("gates")) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

void add_gate_verb(CLI::App& app, VerbAction& action) {
  const auto options = std::make_shared<GateOptions>();
  CLI::App* verb = app.add_subcommand("gate", kGateHelp);
  verb->footer(kGateExamples);
  verb->add_option("LAYOUT", options->layout, "layout file or shipped layout: " + join_names())->required();
  verb->add_flag("--json", options->json, "print JSON instead of the table");
  verb->add_option("--svg", options->svg, "also save a scale drawing of the gate to this file")->type_name("FILE");
  verb->callback([options, &action] { action = [options] { return show_gate(*options); }; });
}

}  // namespace gearshift::verbs
