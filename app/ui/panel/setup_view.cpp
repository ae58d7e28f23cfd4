#include "app/ui/panel/setup_view.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/ui/panel/palette.h"
#include "app/ui/panel/panel_keys.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/safety/energy_control.h"

namespace gearshift::ui {
namespace {

float label_width() {
  return 9.3f * engine::ui_em();
}

template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (int i = 0; i <= static_cast<int>(last_value(Enum{})); ++i) names.emplace_back(to_string(static_cast<Enum>(i)));
  return names;
}

template <class Enum>
void draw_choice(Controls& controls, const char* key, Enum& value) {
  static const std::vector<std::string> names = names_of<Enum>();
  const auto chosen = controls.choice(key, to_string(value), names, ImGui::GetContentRegionAvail().x);
  if (chosen) value = static_cast<Enum>(std::find(names.begin(), names.end(), *chosen) - names.begin());
}

void draw_parameter(Controls& controls, const auto& parameter, auto& value) {
  using Value = std::remove_cvref_t<decltype(value)>;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(parameter.label);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", parameter.description);
  ImGui::SameLine(label_width());
  ImGui::PushID(parameter.key);
  if constexpr (std::is_same_v<Value, bool>) {
    ImGui::Checkbox("##on", &value);
    controls.mark(parameter.key);
  } else if constexpr (std::is_enum_v<Value>) {
    draw_choice(controls, parameter.key, value);
  } else {
    double wide = static_cast<double>(value);
    if (controls.slider(parameter.key, parameter.range, parameter.display, wide)) value = static_cast<Value>(wide);
  }
  ImGui::PopID();
}

}  // namespace

// Discards the edited values when the running configuration changes.
void SetupView::follow(const haptics::HapticConfig& running) {
  haptics::HapticConfig setup = running;
  setup.tuning = {};
  if (!running_ || setup != *running_) {
    staged_ = running;
    running_ = setup;
  }
  staged_.tuning = running.tuning;
}

bool SetupView::is_changed() const {
  haptics::HapticConfig setup = staged_;
  setup.tuning = {};
  return setup != running_;
}

void SetupView::draw_fields(Controls& controls) {
  haptics::each_section(staged_, [&](std::string_view section, auto& part) {
    if (section == "tuning") return;  // has its own tab
    haptics::each_parameter(part,
                            [&](const auto& parameter, auto& value) { draw_parameter(controls, parameter, value); });
  });
}

// Checks the edited values only after a change, because a check can take milliseconds.
void SetupView::judge(const PanelInput& input) {
  const TuningQuestion question{staged_, input.device, haptics::max_feel_stiffness(input.gate)};
  if (question == judged_) return;
  judged_ = question;
  rejection_.clear();
  limits_text_.clear();
  try {
    haptics::check_config(staged_);
    for (const haptics::TuningLimit& limit :
         haptics::admit_tuning(staged_, input.device, question.feel_stiffness).limits)
      limits_text_ += (limits_text_.empty() ? "" : "\n") + format_limit(limit);
  } catch (const std::invalid_argument& refused) {
    rejection_ = refused.what();
  }
}

void SetupView::draw(Controls& controls, const PanelInput& input, PanelCommands& out) {
  follow(input.haptics);
  const float verdict = 3.0f * engine::ui_font_size(engine::UiFont::small) + 2.0f * ImGui::GetStyle().ItemSpacing.y;
  begin_child("values", {0.0f, -ImGui::GetFrameHeightWithSpacing() - verdict});
  {
    const engine::WithFont small(engine::UiFont::small);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0.15f * engine::ui_em()});
    ImGui::TextDisabled("Changes apply when the loop restarts.");
    draw_fields(controls);
    ImGui::PopStyleVar();
  }
  ImGui::EndChild();
  draw_restart(controls, input, out);
}

// Draws the buttons and the result of the check below the scrolling fields, where both are always visible.
void SetupView::draw_restart(Controls& controls, const PanelInput& input, PanelCommands& out) {
  const bool changed = is_changed();
  if (changed) judge(input);
  ImGui::BeginDisabled(!changed || !rejection_.empty());
  if (controls.button("restart", "Restart loop")) out.push_back(Restart{staged_});
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!changed);
  if (controls.button("revert", "Revert")) running_.reset();
  ImGui::EndDisabled();
  const bool allow_unstable = staged_.contact.allow_unstable;
  if (!changed && !allow_unstable) return;
  const std::string text = !rejection_.empty() && changed ? rejection_ : changed ? limits_text_ : std::string{};
  const engine::WithFont small(engine::UiFont::small);
  ImGui::PushStyleColor(ImGuiCol_Text, changed && !rejection_.empty() ? ink::kBad : ink::kWarn);
  ImGui::TextWrapped("%s", text.empty() && allow_unstable
                               ? "Unstable values are allowed, so all values are used exactly as set."
                               : text.c_str());
  ImGui::PopStyleColor();
}

}  // namespace gearshift::ui
