#include "app/reproduce/reproduce.h"

#include <algorithm>
#include <array>
#include <exception>

#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/simulated_run.h"

namespace gearshift {
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

// A whole lever that is never stepped: it refuses what the loop would refuse.
void ask_loop(Study& study) {
  RestingHand nobody;
  SimulatedRun run({study.preset.haptics, study.preset.lever, study.gate, rest_position(study.gate, kNeutralGear)},
                   nobody);
  study.device = run.lever().spec();
  study.admitted = run.loop().admitted();
}

// What one section cannot make must not cost the others.
Section made_or_why(const NamedSection& section, const Study& study) {
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

Study make_study(const Preset& preset, const GateLayout& layout, const std::filesystem::path& folder) {
  Study study;
  study.preset = preset;
  study.layout = layout;
  study.gate = compile_gate(layout, workspace_half_extent(preset.lever.yoke), preset.lever.yoke.radius);
  study.folder = folder;
  ask_loop(study);
  return study;
}

std::vector<Section> make_sections(Study study, const std::vector<std::string>& only,
                                   const ReproduceProgress& progress) {
  const std::vector<NamedSection> chosen = chosen_sections(only);
  std::vector<Section> made;
  study.doing = [&](std::string_view) {  // a terminal's line has no room for more than the section
    progress(chosen[made.size()].id, static_cast<double>(made.size()) / static_cast<double>(chosen.size()));
  };
  for (const NamedSection& section : chosen) {
    study.doing("run");
    made.push_back(made_or_why(section, study));
  }
  return made;
}

}  // namespace gearshift
