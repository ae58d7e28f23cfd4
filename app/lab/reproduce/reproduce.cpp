#include "app/lab/reproduce/reproduce.h"

#include <algorithm>
#include <array>
#include <exception>

#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift::lab {
namespace {

constexpr std::array<NamedSection, 13> kSections{{
    {"workspace", workspace_section},            // section 2.1
    {"force_map", force_map_section},            // 2.2
    {"calibration", calibration_section},        // 2.3
    {"bode", bode_section},                      // 2.4
    {"table", table_section},                    // 2.4
    {"elements", elements_section},              // 3
    {"deferred_force", deferred_force_section},  // 3.1
    {"over_push", over_push_section},            // 3.1
    {"oscillation", oscillation_section},        // 3.1
    {"rate", rate_section},                      // 3.1
    {"gate", gate_section},                      // 4
    {"wall", wall_section},                      // 4
    {"tour", tour_section},                      // 4
}};

std::vector<NamedSection> chosen_sections(const std::vector<std::string>& only) {
  std::vector<NamedSection> chosen;
  for (const NamedSection& section : kSections) {
    if (only.empty() || std::find(only.begin(), only.end(), section.id) != only.end()) chosen.push_back(section);
  }
  return chosen;
}

// Constructs a lever and a loop without running them. The constructors throw if the configuration is invalid, and
// compute the admitted tuning.
void query_loop(Study& study) {
  haptics::IdleHand idle_hand;
  haptics::SimulatedRun run(
      {study.preset.haptics, study.preset.lever, study.gate, haptics::rest_position(study.gate, haptics::kNeutralGear)},
      idle_hand);
  study.device = run.lever().spec();
  study.admitted = run.loop().admitted();
}

// If a section fails, returns a section that contains only the reason, so that the other sections can still be made.
Section make_or_explain(const NamedSection& section, const Study& study) {
  try {
    return section.make(study);
  } catch (const std::exception& problem) {
    Section failed;
    failed.id = failed.title = section.id;
    failed.problem = problem.what();
    return failed;
  }
}

}  // namespace

std::span<const NamedSection> all_sections() {
  return kSections;
}

Study make_study(const haptics::Preset& preset, const haptics::GateLayout& layout,
                 const std::filesystem::path& folder) {
  Study study;
  study.preset = preset;
  study.layout = layout;
  study.gate =
      haptics::compile_gate(layout, haptics::workspace_half_extent(preset.lever.yoke), preset.lever.yoke.radius);
  study.folder = folder;
  query_loop(study);
  return study;
}

std::vector<Section> make_sections(Study study, const std::vector<std::string>& only,
                                   const ReproduceProgress& progress) {
  const std::vector<NamedSection> chosen = chosen_sections(only);
  std::vector<Section> made;
  study.on_progress = [&](std::string_view) {  // ignores the text, because the progress bar shows the section's name
    progress(chosen[made.size()].id, static_cast<double>(made.size()) / static_cast<double>(chosen.size()));
  };
  for (const NamedSection& section : chosen) {
    study.on_progress("run");
    made.push_back(make_or_explain(section, study));
  }
  return made;
}

}  // namespace gearshift::lab
