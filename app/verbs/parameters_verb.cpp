// gearshift parameters: prints every parameter of a preset with its range, default and meaning.
#include <memory>
#include <string>

#include "app/base/console.h"
#include "app/verbs/verbs.h"
#include "haptics/loop/preset.h"

namespace gearshift::verbs {

void add_parameters_verb(CLI::App& app, VerbAction& action) {
  auto as_table = std::make_shared<bool>(false);
  CLI::App* verb =
      app.add_subcommand("parameters", "Print all parameters of a preset, with ranges, defaults and meaning");
  verb->footer(
      "Examples:\n"
      "  gearshift parameters > my.toml\n"
      "  gearshift parameters --table\n");
  verb->add_flag("--table", *as_table,
                 "print the parameters of the panel as a Markdown table, instead of a preset file");
  verb->callback([as_table, &action] {
    action = [as_table] {
      const haptics::Preset defaults{"The paper's joystick, 1 kHz", {}, {}};
      base::print_out("{}", *as_table ? haptics::parameter_table(defaults.haptics)
                                      : haptics::preset_text(defaults, haptics::PresetComments::descriptions));
      return 0;
    };
  });
}

}  // namespace gearshift::verbs
