// gearshift reproduce: every figure and table of the paper from one preset, as one page.
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "app/assets_path.h"
#include "app/limited_words.h"
#include "app/output_folder.h"
#include "app/print_out.h"
#include "app/reproduce/page.h"
#include "app/reproduce/reproduce.h"
#include "app/verbs/unless_ended.h"
#include "app/verbs/verbs.h"
#include "haptics/gate/gate_layout.h"

namespace gearshift {
namespace {

struct ReproduceArguments {
  std::string folder;
  std::string preset = "default";
  std::vector<std::string> only;
};

std::string ids() {
  std::vector<std::string_view> names;
  for (const NamedSection& section : all_sections()) names.push_back(section.id);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string refuse_unknown_section(const std::string& id) {
  const auto sections = all_sections();
  const bool known =
      std::any_of(sections.begin(), sections.end(), [&](const NamedSection& section) { return section.id == id; });
  return known ? std::string{} : fmt::format("\"{}\" is no section: {}", id, ids());
}

void print_result(const Study& study, const std::vector<Section>& sections) {
  for (const Limited& limited : study.admitted.limited) {
    print_problem("{}", limited_words(limited));
  }
  for (const Section& section : sections) {
    if (!section.problem.empty()) print_problem("{}: {}", section.id, section.problem);
    if (section.findings.empty()) continue;
    const Finding& main = section.findings.front();
    print_out("{:<14}  {}: {}\n", section.id, main.paper, main.ours);
  }
  print_out("{}\n", (study.folder / "index.html").string());
}

// All that can be refused is refused before the folder is made.
int run_reproduce(const ReproduceArguments& arguments) {
  const Preset preset = read_preset(find_asset("presets", arguments.preset).string());
  const Study study = make_study(preset, read_gate_layout(find_asset("gates", "paper")), arguments.folder);
  make_folder(study.folder);
  const auto sections = unless_ended<std::vector<Section>>(
      [&](const ReproduceProgress& progress) { return make_sections(study, arguments.only, progress); });
  if (!sections) return 1;
  write_page(study, *sections);
  print_result(study, *sections);
  const bool whole =
      std::all_of(sections->begin(), sections->end(), [](const Section& s) { return s.problem.empty(); });
  return whole ? 0 : 1;
}

}  // namespace

void add_reproduce_verb(CLI::App& app, VerbAction& action) {
  auto arguments = std::make_shared<ReproduceArguments>();
  CLI::App* verb =
      app.add_subcommand("reproduce", "Every figure and table of the paper, beside what it says, as one page");
  verb->footer(
      "Examples:\n"
      "  gearshift reproduce --out paper\n");
  verb->add_option("--out", arguments->folder, "folder for page, pictures and data; made where missing")
      ->type_name("DIR")
      ->required();
  verb->add_option("--preset", arguments->preset, "shipped preset or file")->capture_default_str();
  verb->add_option("--only", arguments->only, "sections: " + ids())->type_name("ID")->check(refuse_unknown_section);
  verb->callback([arguments, &action] { action = [arguments] { return run_reproduce(*arguments); }; });
}

}  // namespace gearshift
