// gearshift reproduce: reproduces every figure and table of the paper from one preset, as one page.
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/base/assets_path.h"
#include "app/base/console.h"
#include "app/base/output_folder.h"
#include "app/base/run_until_signal.h"
#include "app/lab/reproduce/page.h"
#include "app/lab/reproduce/reproduce.h"
#include "app/verbs/verbs.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::verbs {
namespace {

struct ReproduceArguments {
  std::string folder;
  std::string preset = "default";
  std::vector<std::string> only;
};

std::string ids() {
  std::vector<std::string_view> names;
  for (const lab::NamedSection& section : lab::all_sections()) names.push_back(section.id);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string reject_unknown_section(const std::string& id) {
  const auto sections = lab::all_sections();
  const bool known =
      std::any_of(sections.begin(), sections.end(), [&](const lab::NamedSection& section) { return section.id == id; });
  return known ? std::string{} : fmt::format("there is no section \"{}\"; the sections are {}", id, ids());
}

void print_result(const lab::Study& study, const std::vector<lab::Section>& sections) {
  for (const haptics::TuningLimit& limited : study.admitted.limits) {
    base::print_message("{}", haptics::describe(limited));
  }
  for (const lab::Section& section : sections) {
    if (!section.problem.empty()) base::print_message("{}: {}", section.id, section.problem);
    if (section.findings.empty()) continue;
    const lab::Finding& main = section.findings.front();
    base::print_out("{}\n  paper      {}\n  gearshift  {}\n", section.id, main.paper, main.result);
  }
  base::print_out("{}\n", (study.folder / "index.html").string());
}

// Runs the verb. Creates the output folder only after all arguments are checked.
int run_reproduce(const ReproduceArguments& arguments) {
  const haptics::Preset preset = haptics::read_preset(base::find_asset("presets", arguments.preset).string());
  const lab::Study study =
      lab::make_study(preset, haptics::read_gate_layout(base::find_asset("gates", "paper")), arguments.folder);
  base::make_folder(study.folder);
  const auto sections = base::run_until_signal<std::vector<lab::Section>>(
      [&](const lab::ReproduceProgress& progress) { return lab::make_sections(study, arguments.only, progress); });
  if (!sections) return 1;
  lab::write_page(study, *sections);
  print_result(study, *sections);
  const bool is_complete =
      std::all_of(sections->begin(), sections->end(), [](const lab::Section& s) { return s.problem.empty(); });
  return is_complete ? 0 : 1;
}

}  // namespace

void add_reproduce_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<ReproduceArguments>();
  CLI::App* verb = app.add_subcommand(
      "reproduce", "Reproduce every figure and table of the paper on a page, next to the published values");
  verb->footer(
      "Examples:\n"
      "  gearshift reproduce --out paper\n");
  verb->add_option("--out", arguments->folder, "folder for the page, pictures and data; created if missing")
      ->type_name("DIR")
      ->required();
  verb->add_option("--preset", arguments->preset, "shipped preset or preset file")->capture_default_str();
  verb->add_option("--only", arguments->only, "create only these sections: " + ids())
      ->type_name("ID")
      ->check(reject_unknown_section);
  verb->callback([arguments, &action] { action = [arguments] { return run_reproduce(*arguments); }; });
}

}  // namespace gearshift::verbs
