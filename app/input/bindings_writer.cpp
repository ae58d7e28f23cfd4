#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/core.h>

#include "app/input/bindings.h"
#include "app/input/key_names.h"
#include "haptics/files/printable.h"
#include "haptics/files/readable_file.h"

namespace gearshift {
namespace {

namespace fs = std::filesystem;

// A basic string of TOML: quotes and backslashes are escaped; control characters are the reader's to refuse.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// The shortest that reads back to the bit, whatever the locale.
std::string digits_of(double value) {
  char digits[64];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string line(std::string_view key, const std::string& value) {
  return fmt::format("{} = {}\n", key, value);
}

template <class Name>
std::string actions_text(const std::map<Action, std::vector<int>>& bound, const Name& name) {
  std::string text;
  for (const ActionInfo& action : all_actions()) {
    const auto found = bound.find(action.action);
    if (found == bound.end()) continue;
    std::string list;
    for (const int code : found->second) list += (list.empty() ? "" : ", ") + name(code);
    text += line(action.key, in_quotes(list));
  }
  return text;
}

std::string axis_text(std::string_view key, const std::optional<AxisBinding>& axis) {
  if (!axis) return {};
  std::string text = fmt::format("\n[pad_axes.{}]\n", key);
  if (!axis->stick.empty()) text += line("stick", in_quotes(axis->stick));
  text += line("pad", std::to_string(axis->pad)) + line("axis", std::to_string(axis->axis));
  text += line("from", digits_of(axis->from)) + line("to", digits_of(axis->to));
  if (axis->centre) text += line("centre", digits_of(*axis->centre));
  return text + line("dead_zone", digits_of(axis->dead_zone)) + line("end_zone", digits_of(axis->end_zone));
}

}  // namespace

std::string bindings_text(const Bindings& bindings) {
  std::string text = "[keys]\n" + actions_text(bindings.keys, key_name) + "\n[pad_buttons]\n";
  if (!bindings.button_stick.empty()) text += line("stick", in_quotes(bindings.button_stick));
  text += actions_text(bindings.pad_buttons, [](int button) { return std::to_string(button); });
  text += axis_text("lever_select", bindings.lever_select) + axis_text("lever_shift", bindings.lever_shift) +
          axis_text("throttle", bindings.throttle) + axis_text("brake", bindings.brake) +
          axis_text("clutch", bindings.clutch);
  text += "\n[lever]\n" + line("mode", bindings.lever_mode == LeverMode::moves ? "\"moves\"" : "\"places\"") +
          line("full_speed_m_per_s", digits_of(bindings.stick_speed));
  return text + "\n[pace]\n" + line("mouse_mm_per_px", digits_of(bindings.mouse_mm_per_px)) +
         line("lever_key_m_per_s", digits_of(bindings.key_speed)) +
         line("pedal_key_s", digits_of(bindings.pedal_time)) +
         line("clutch_key_slip_s", digits_of(bindings.clutch_slip_time));
}

void write_bindings(const Bindings& bindings, const fs::path& file) {
  write_readable_file(file, bindings_text(bindings), [](const auto& written) { (void)read_bindings(written); });
}

fs::path own_bindings_file(const fs::path& config_folder, const std::string& name) {
  const bool is_file = !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
  if (!is_file)
    throw std::invalid_argument(fmt::format(
        "\"{}\" cannot be the name of bindings: it is empty, begins with a dot or has a slash", printable(name)));
  return config_folder / "bindings" / (name + ".toml");
}

}  // namespace gearshift
