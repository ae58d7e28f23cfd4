// gearshift parameters: prints every parameter of a preset with its range, default and meaning, and the tables of the
// documents.
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "app/base/console.h"
#include "app/lessons/assessment/lesson.h"
#include "app/vehicle/car_spec.h"
#include "app/verbs/verbs.h"
#include "haptics/files/parameter_file.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/preset.h"

namespace gearshift::verbs {
namespace {

using haptics::ParameterTable;

std::string lever_table() {
  ParameterTable table;
  const haptics::SimulatedLeverConfig defaults;
  haptics::each_section(defaults,
                        [&](const std::string& section, const auto& part) { table.add('[' + section + ']', part); });
  return table.text();
}

std::string gate_table() {
  return ParameterTable()
      .add("", haptics::GateLayout{})
      .add("", haptics::FeelLayout{})
      .add("", haptics::LockoutLayout{})
      .text();
}

std::string car_table() {
  return ParameterTable(haptics::Missing::error)
      .add("", vehicle::CarSpec{})
      .add("[engine]", vehicle::EngineSpec{})
      .add("[clutch]", vehicle::ClutchSpec{})
      .add("[gearbox]", vehicle::GearboxSpec{})
      .add("[synchro]", vehicle::SynchroSpec{})
      .add("[body]", vehicle::BodySpec{})
      .text();
}

std::string lesson_table() {
  return ParameterTable()
      .add("", lessons::Lesson{})
      .add("[start]", lessons::LessonStart{})
      .add("[[step]]", lessons::LessonStep{})
      .text();
}

// Every table of parameters, by kind.
const std::map<std::string, std::function<std::string()>>& tables() {
  static const std::map<std::string, std::function<std::string()>> all = {
      {"car", car_table},
      {"condition", [] { return ParameterTable().add("", lessons::DriveCondition{}).text(); }},
      {"gate", gate_table},
      {"haptics", [] { return haptics::parameter_table(haptics::HapticConfig{}); }},
      {"lesson", lesson_table},
      {"lever", lever_table},
  };
  return all;
}

}  // namespace

void add_parameters_verb(CLI::App& app, VerbAction& action) {
  auto kind = std::make_shared<std::string>();
  CLI::App* verb =
      app.add_subcommand("parameters", "Print all parameters of a preset, with ranges, defaults and meaning");
  verb->footer(
      "Examples:\n"
      "  gearshift parameters > my.toml\n"
      "  gearshift parameters --table car\n");
  verb->add_option(
          "--table", *kind,
          "print a Markdown table instead: the numbers of a preset (haptics, lever), a car, a gate, a lesson or "
          "its conditions")
      ->check(CLI::IsMember(tables()));
  verb->callback([kind, &action] {
    action = [kind] {
      const haptics::Preset defaults{"The paper's joystick, 1 kHz", {}, {}};
      base::print_out("{}", kind->empty() ? haptics::preset_text(defaults, haptics::PresetComments::descriptions)
                                          : tables().at(*kind)());
      return 0;
    };
  });
}

}  // namespace gearshift::verbs
