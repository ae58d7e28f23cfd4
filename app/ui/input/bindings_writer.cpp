#include <algorithm>
#include <stdexcept>

#include <fmt/core.h>

#include "app/ui/input/bindings.h"
#include "app/ui/input/key_names.h"
#include "haptics/files/parameter_file.h"
#include "haptics/files/printable.h"
#include "haptics/files/toml_text.h"
#include "haptics/files/verified_file.h"

namespace gearshift::ui {
namespace {

namespace fs = std::filesystem;

std::string line(std::string_view key, const std::string& value) {
  return fmt::format("{} = {}\n", key, value);
}

std::string name_text(const ControllerName& of) {
  return (of.stick.empty() ? std::string() : line("stick", haptics::toml_string(of.stick))) +
         (of.id.empty() ? std::string() : line("id", haptics::toml_string(of.id)));
}

template <class Name>
std::string list_text(const std::vector<int>& codes, const Name& name) {
  std::string list;
  for (const int code : codes) list += (list.empty() ? "" : ", ") + name(code);
  return haptics::toml_string(list);
}

template <class Name>
std::string actions_text(const std::map<Action, std::vector<int>>& bound, const Name& name) {
  std::string text;
  for (const ActionInfo& action : all_actions()) {
    const auto found = bound.find(action.action);
    if (found != bound.end()) text += line(action.key, list_text(found->second, name));
  }
  return text;
}

std::string axis_text(std::string_view key, const std::optional<AxisBinding>& axis) {
  if (!axis) return {};
  std::string text = fmt::format("\n[pad_axes.{}]\n", key);
  text += name_text(axis->of) + line("pad", std::to_string(axis->which));
  text +=
      line("axis", axis->of.stick.empty() ? haptics::toml_string(kPadAxes[axis->axis]) : std::to_string(axis->axis));
  text += line("from", haptics::toml_number(axis->from)) + line("to", haptics::toml_number(axis->to));
  if (axis->centre) text += line("centre", haptics::toml_number(*axis->centre));
  return text + line("dead_zone", haptics::toml_number(axis->dead_zone)) +
         line("end_zone", haptics::toml_number(axis->end_zone));
}

}  // namespace

std::string bindings_text(const Bindings& bindings) {
  std::string text = "[keys]\n" + actions_text(bindings.keys, key_name) + "\n[pad_buttons]\n" +
                     actions_text(bindings.pad_buttons, [](int button) { return std::string(kPadButtons[button]); });
  for (const AxisInfo& info : kAxes) text += axis_text(info.key, bindings.*info.axis);
  const auto number = [](int button) { return std::to_string(button); };
  for (const ControllerButtons& controller : bindings.controllers) {
    text += "\n[[controller]]\n" + name_text(controller.of) + line("pad", std::to_string(controller.which)) +
            actions_text(controller.actions, number);
    for (const auto& [gear, buttons] : controller.gears) text += line(gear_key(gear), list_text(buttons, number));
  }
  return text + "\n[lever]\n" + haptics::parameters_text(bindings.lever, false) + "\n[pace]\n" +
         haptics::parameters_text(bindings.pace, false) + haptics::parameters_text(bindings.pedal_timing, false);
}

void write_bindings(const Bindings& bindings, const fs::path& file) {
  haptics::write_verified_file(file, bindings_text(bindings),
                               [](const auto& written) { (void)read_bindings(written); });
}

fs::path user_bindings_file(const fs::path& config_folder, const std::string& name) {
  const bool is_file = !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
  if (!is_file)
    throw std::invalid_argument(fmt::format(
        "\"{}\" is not a valid name for bindings: it must not be empty, start with a dot or contain a slash",
        haptics::printable(name)));
  return config_folder / "bindings" / (name + ".toml");
}

}  // namespace gearshift::ui
