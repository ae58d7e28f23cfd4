#include "haptics/loop/preset.h"

#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "haptics/files/parameter_file.h"
#include "haptics/files/text_file.h"
#include "haptics/files/toml_reader.h"
#include "haptics/files/toml_text.h"
#include "haptics/files/verified_file.h"

namespace gearshift::haptics {
namespace {

constexpr const char* kHandDescription = "bare, light, grip, arm or \"M,B,K\" in kg, N s/m and N/m.";

// Calls visit(section, part) for each section of a preset file and the struct that it sets. Outer sections come first.
void each_preset_section(auto& preset, auto&& visit) {
  each_section(preset.lever, visit);
  each_section(preset.haptics, visit);
}

// The tables of a preset file that were opened, by section: "lever.yoke".
class Sections {
 public:
  explicit Sections(const TomlTable& root) : root_(root) {}

  // The section's table; null if the file has none.
  const TomlTable* find(std::string_view section) {
    const auto found = open_.find(section);
    if (found != open_.end()) return &found->second;
    const std::size_t dot = section.rfind('.');
    const bool is_inner = dot != std::string_view::npos;
    const TomlTable* outer = is_inner ? find(section.substr(0, dot)) : &root_;
    const std::string_view key = is_inner ? section.substr(dot + 1) : section;
    if (outer == nullptr || !outer->has(key)) return nullptr;
    return &open_.emplace(section, outer->table(key)).first->second;
  }

  void reject_unknown_keys() const {
    for (const auto& [section, table] : open_) table.reject_unknown_keys();
    root_.reject_unknown_keys();
  }

 private:
  const TomlTable& root_;
  std::map<std::string, TomlTable, std::less<>> open_;
};

void read_lever_text(const TomlTable& table, SimulatedLeverConfig& lever) {
  if (lever.encoder_counts > 0.0 && lever.encoder_counts < 1.0)
    table.fail("encoder_counts_per_deg", "must be 0 (no encoder) or at least 1");
  if (!table.has("hand")) return;
  const std::optional<HandImpedance> hand = parse_hand(table.text("hand"));
  const auto max = [](double HandImpedance::*member) { return number_text(parameter_of(member).range.max); };
  if (!hand || !is_in_range(*hand))
    table.fail("hand",
               "must be bare, light, grip, arm, elastic, pinch or \"M,B,K\" up to " + max(&HandImpedance::mass) +
                   " kg, " + max(&HandImpedance::damping) + " N s/m and " + max(&HandImpedance::stiffness) +
                   " N/m, followed by the fingers' mass and the grip's damping and stiffness for an elastic hand");
  lever.hand = *hand;
}

}  // namespace

Preset read_preset(const std::string& file) {
  return parse_preset(read_text_file(file), file);
}

Preset parse_preset(std::string_view text, const std::string& file_name) {
  const TomlTable root = TomlTable::parse(text, file_name);
  Preset preset;
  preset.name = root.text("name");
  Sections sections(root);
  each_preset_section(preset, [&](std::string_view section, auto& part) {
    if (const TomlTable* table = sections.find(section)) read_parameters(*table, part);
  });
  if (const TomlTable* lever = sections.find("lever")) read_lever_text(*lever, preset.lever);
  sections.reject_unknown_keys();
  return preset;
}

std::string preset_text(const Preset& preset, PresetComments comments) {
  std::string text = "name = " + toml_string(preset.name) + '\n';
  const bool described = comments == PresetComments::descriptions;
  std::string_view last;
  each_preset_section(preset, [&](std::string_view section, const auto& part) {
    if (section != last) text += "\n[" + std::string(section) + "]\n";
    if (last.empty())
      text += commented("hand = " + toml_string(hand_text(preset.lever.hand)), described ? kHandDescription : "");
    last = section;
    text += parameters_text(part, described);
  });
  return text;
}

std::string parameter_table(const HapticConfig& defaults) {
  std::string text =
      "key | panel | allowed | default | effect if too low; if too high\n"
      "---|---|---|---|---\n";
  each_section(defaults, [&](std::string_view section, const auto& part) {
    each_parameter(part, [&](const auto& parameter, const auto& value) {
      const bool has_low = *parameter.too_low != '\0', has_high = *parameter.too_high != '\0';
      text += "`[" + std::string(section) + "] " + parameter.key + "` | " + parameter.label + " | " +
              allowed_text(parameter, value) + " | " + value_text(parameter, value) + " | " + parameter.too_low +
              (has_low || has_high ? "; " : "") + parameter.too_high + '\n';
    });
  });
  return text;
}

void write_preset(const Preset& preset, const std::filesystem::path& file) {
  write_verified_file(file, preset_text(preset), [](const auto& written) { (void)read_preset(written.string()); });
}

}  // namespace gearshift::haptics
