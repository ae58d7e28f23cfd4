#include "app/ui/panel/preset_view.h"

#include <fmt/format.h>

#include "app/ui/panel/format_value.h"
#include "app/ui/panel/palette.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/safety/energy_control.h"

namespace gearshift::ui {
namespace {

// Draws a row for each setting that differs between two presets, and the number of settings that are equal.
class Difference {
 public:
  void row(const char* label, const std::string& here, const std::string& there) {
    if (here == there) {
      ++same_;
      return;
    }
    ++different_;
    ImGui::TableNextRow();
    for (const char* text : {label, here.c_str(), there.c_str()}) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(text);
    }
  }
  int same() const { return same_; }
  int different() const { return different_; }

 private:
  int same_ = 0, different_ = 0;
};

// The part of the configuration that has this type.
template <class Part>
const Part& part_of(const haptics::HapticConfig& config) {
  const Part* found = nullptr;
  haptics::each_section(config, [&](std::string_view, const auto& part) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(part)>, Part>) found = &part;
  });
  return *found;
}

void draw_rows(Difference& rows, const haptics::HapticConfig& here, const haptics::HapticConfig& there) {
  haptics::each_section(here, [&](std::string_view, const auto& part) {
    const auto& other = part_of<std::remove_cvref_t<decltype(part)>>(there);
    haptics::each_parameter(part, [&](const auto& parameter, const auto& value) {
      using Value = std::remove_cvref_t<decltype(value)>;
      rows.row(parameter.label, format_value(parameter, value),
               format_value(parameter, haptics::value_in<Value>(other, parameter)));
    });
  });
}

void draw_difference(const PanelInput& input) {
  haptics::HapticConfig here = input.haptics;
  here.tuning = input.admitted.tuning;
  Difference rows;
  const engine::WithFont small(engine::UiFont::small);
  if (ImGui::BeginTable("difference", 3, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH)) {
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("current");
    ImGui::TableSetupColumn("preset");
    ImGui::TableHeadersRow();
    draw_rows(rows, here, input.compared->haptics);
    ImGui::EndTable();
  }
  ImGui::TextDisabled(
      rows.different() == 1 ? "%d setting differs, %d are the same" : "%d settings differ, %d are the same",
      rows.different(), rows.same());
}

}  // namespace

void PresetView::draw(Controls& controls, const PanelInput& input, PanelCommands& out) {
  draw_save(controls, out);
  ImGui::Spacing();
  ImGui::Separator();
  draw_compare(controls, input, out);
}

void PresetView::draw_save(Controls& controls, PanelCommands& out) {
  ImGui::TextUnformatted("Save current settings as");
  const float button = 4.5f * engine::ui_em();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  const bool entered = ImGui::InputTextWithHint("##save_name", "preset name", name_.data(), name_.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  controls.mark("save_name");
  ImGui::SameLine();
  const bool empty = name_.front() == '\0';
  ImGui::BeginDisabled(empty);
  const bool pressed = controls.button("save", "Save", {button, 0.0f});
  ImGui::EndDisabled();
  if ((entered || pressed) && !empty) out.push_back(SavePreset{name_.data()});
}

void PresetView::draw_compare(Controls& controls, const PanelInput& input, PanelCommands& out) {
  ImGui::TextUnformatted("Compare with");
  const auto chosen = controls.choice("compare", compared_.empty() ? "choose a preset" : compared_, input.presets,
                                      ImGui::GetContentRegionAvail().x);
  if (chosen) out.push_back(ComparePreset{compared_ = *chosen});
  if (!compared_.empty() && input.compared) draw_difference(input);
}

}  // namespace gearshift::ui
