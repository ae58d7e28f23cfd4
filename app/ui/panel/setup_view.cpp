#include "app/ui/panel/setup_view.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/ui/panel/palette.h"
#include "app/ui/panel/tuning_check.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/safety/energy_control.h"

namespace gearshift::ui {
namespace {

constexpr haptics::ContactHold kHolds[] = {haptics::ContactHold::automatic, haptics::ContactHold::zero_order,
                                           haptics::ContactHold::half_sample, haptics::ContactHold::observer};
constexpr haptics::EnergyControl kEnergyControls[] = {haptics::EnergyControl::none,
                                                      haptics::EnergyControl::energy_bounding,
                                                      haptics::EnergyControl::passivity_controller};

template <class Kind>
void choose(Controls& controls, const char* name, const char* label, Kind& value, std::span<const Kind> kinds,
            const char* (*words)(Kind) noexcept, float label_width) {
  std::vector<std::string> names;
  for (const Kind kind : kinds) names.emplace_back(words(kind));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(label_width);
  const auto chosen = controls.choice(name, words(value), names, ImGui::GetContentRegionAvail().x);
  if (chosen) value = kinds[static_cast<std::size_t>(std::find(names.begin(), names.end(), *chosen) - names.begin())];
}

float label_width() {
  return 9.3f * engine::ui_em();
}

void draw_checkbox(Controls& controls, const char* name, const char* label, bool& on) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine();
  ImGui::PushID(name);
  ImGui::Checkbox("##on", &on);
  ImGui::PopID();
  controls.mark(name);
}

}  // namespace

SetupView::Values SetupView::values_of(const haptics::HapticConfig& config) {
  Values values{};
  for (std::size_t i = 0; i < kSetupFields.size(); ++i) values[i] = kSetupFields[i].get(config);
  values[kSetupFields.size()] = static_cast<double>(config.contact.hold);
  values[kSetupFields.size() + 1] = static_cast<double>(config.contact.energy_control);
  values[kSetupFields.size() + 2] = config.contact.reversal_limiter ? 1.0 : 0.0;
  values[kSetupFields.size() + 3] = config.contact.allow_unstable ? 1.0 : 0.0;
  return values;
}

// Discards the edited values when the running configuration changes.
void SetupView::follow(const haptics::HapticConfig& running) {
  const Values values = values_of(running);
  if (!has_values_ || values != running_) {
    staged_ = running;
    running_ = values;
    has_values_ = true;
  }
  staged_.tuning = running.tuning;
}

void SetupView::draw_fields(Controls& controls) {
  for (const SetupField& field : kSetupFields) {
    double shown = field.factor * field.get(staged_);
    const double min = field.factor * field.min, max = field.factor * field.max;
    const std::string format = fmt::format("%.{}f {}", field.decimals, field.unit);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(field.label);
    ImGui::SameLine(label_width());
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::PushID(field.key);
    const int flags = ImGuiSliderFlags_AlwaysClamp | (field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    if (ImGui::SliderScalar("##value", ImGuiDataType_Double, &shown, &min, &max, format.c_str(), flags))
      field.set(staged_, std::clamp(shown / field.factor, field.min, field.max));
    ImGui::PopID();
    controls.mark(field.key);
  }
}

void SetupView::draw_choices(Controls& controls) {
  choose<haptics::ContactHold>(controls, "hold", "Hold", staged_.contact.hold, kHolds, haptics::to_string,
                               label_width());
  choose<haptics::EnergyControl>(controls, "energy_control", "Energy control", staged_.contact.energy_control,
                                 kEnergyControls, haptics::to_string, label_width());
  draw_checkbox(controls, "reversal_limiter", "Reversal limiter", staged_.contact.reversal_limiter);
  ImGui::SameLine(0.0f, 1.2f * engine::ui_em());
  draw_checkbox(controls, "study", "Allow unstable", staged_.contact.allow_unstable);
}

// Checks the edited values only after a change, because a check can take milliseconds.
void SetupView::judge(const PanelInput& input) {
  const Values staged = values_of(staged_);
  if (staged == judged_) return;
  judged_ = staged;
  rejection_.clear();
  limits_text_.clear();
  try {
    haptics::check_config(staged_);
    for (const haptics::TuningLimit& limit : haptics::admit_tuning(staged_, *input.device, *input.gate).limits)
      limits_text_ += (limits_text_.empty() ? "" : "\n") + format_limit(limit);
  } catch (const std::invalid_argument& refused) {
    rejection_ = refused.what();
  }
}

void SetupView::draw(Controls& controls, const PanelInput& input, PanelRequests& out) {
  follow(input.haptics);
  const float verdict =
      3.0f * engine::ui_font(engine::UiFont::small)->FontSize + 2.0f * ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("values", {0.0f, -ImGui::GetFrameHeightWithSpacing() - verdict}, false,
                    ImGuiWindowFlags_NavFlattened);
  {
    const engine::WithFont small(engine::UiFont::small);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0.15f * engine::ui_em()});
    ImGui::TextDisabled("Changes apply when the loop restarts.");
    draw_choices(controls);
    draw_fields(controls);
    ImGui::PopStyleVar();
  }
  ImGui::EndChild();
  draw_restart(controls, input, out);
}

// Draws the buttons and the result of the check below the scrolling fields, where both are always visible.
void SetupView::draw_restart(Controls& controls, const PanelInput& input, PanelRequests& out) {
  const bool changed = values_of(staged_) != running_;
  if (changed) judge(input);
  ImGui::BeginDisabled(!changed || !rejection_.empty());
  if (controls.button("restart", "Restart loop")) out.restart = staged_;
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!changed);
  if (controls.button("setup_back", "Revert")) has_values_ = false;
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
