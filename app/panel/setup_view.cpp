#include "app/panel/setup_view.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/energy_words.h"
#include "app/hold_words.h"
#include "app/panel/palette.h"
#include "app/panel/tuning_answer.h"

namespace gearshift {
namespace {

constexpr ContactHold kHolds[] = {ContactHold::automatic, ContactHold::zero_order, ContactHold::half_sample,
                                  ContactHold::observer};
constexpr EnergyControl kEnergyControls[] = {EnergyControl::none, EnergyControl::energy_bounding,
                                             EnergyControl::passivity_controller};

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
  return 9.3f * ui_em();
}

void tick(Controls& controls, const char* name, const char* label, bool& on) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine();
  ImGui::PushID(name);
  ImGui::Checkbox("##on", &on);
  ImGui::PopID();
  controls.mark(name);
}

}  // namespace

SetupView::Values SetupView::values_of(const HapticConfig& config) {
  Values values{};
  for (std::size_t i = 0; i < kSetupFields.size(); ++i) values[i] = kSetupFields[i].get(config);
  values[kSetupFields.size()] = static_cast<double>(config.contact.hold);
  values[kSetupFields.size() + 1] = static_cast<double>(config.contact.energy_control);
  values[kSetupFields.size() + 2] = config.contact.reversal_limiter ? 1.0 : 0.0;
  values[kSetupFields.size() + 3] = config.contact.study ? 1.0 : 0.0;
  return values;
}

// Another run: what was staged is forgotten.
void SetupView::follow(const HapticConfig& runs) {
  const Values values = values_of(runs);
  if (!known_ || values != running_) {
    staged_ = runs;
    running_ = values;
    known_ = true;
  }
  staged_.tuning = runs.tuning;
}

void SetupView::draw_fields(Controls& controls) {
  for (const SetupField& field : kSetupFields) {
    double shown = field.factor * field.get(staged_);
    const double least = field.factor * field.least, most = field.factor * field.most;
    const std::string format = fmt::format("%.{}f {}", field.decimals, field.unit);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(field.label);
    ImGui::SameLine(label_width());
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::PushID(field.key);
    const int flags = ImGuiSliderFlags_AlwaysClamp | (field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    if (ImGui::SliderScalar("##value", ImGuiDataType_Double, &shown, &least, &most, format.c_str(), flags))
      field.set(staged_, std::clamp(shown / field.factor, field.least, field.most));
    ImGui::PopID();
    controls.mark(field.key);
  }
}

void SetupView::draw_choices(Controls& controls) {
  choose<ContactHold>(controls, "hold", "Hold", staged_.contact.hold, kHolds, hold_words, label_width());
  choose<EnergyControl>(controls, "energy_control", "Energy control", staged_.contact.energy_control, kEnergyControls,
                        energy_words, label_width());
  tick(controls, "reversal_limiter", "Reversal limiter", staged_.contact.reversal_limiter);
  ImGui::SameLine(0.0f, 1.2f * ui_em());
  tick(controls, "study", "Study", staged_.contact.study);
}

// Asked only where something is another: it costs up to milliseconds.
void SetupView::judge(const PanelInput& input) {
  const Values staged = values_of(staged_);
  if (staged == judged_) return;
  judged_ = staged;
  refused_.clear();
  told_.clear();
  try {
    check_config(staged_);
    for (const Limited& limited : admit_tuning(staged_, *input.device, *input.gate).limited)
      told_ += (told_.empty() ? "" : "\n") + limited_sentence(limited);
  } catch (const std::invalid_argument& refused) {
    refused_ = refused.what();
  }
}

void SetupView::draw(Controls& controls, const PanelInput& input, PanelRequests& out) {
  follow(input.haptics);
  const float verdict = 3.0f * ui_font(UiFont::small)->FontSize + 2.0f * ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("values", {0.0f, -ImGui::GetFrameHeightWithSpacing() - verdict}, false,
                    ImGuiWindowFlags_NavFlattened);
  {
    const WithFont small(UiFont::small);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0.15f * ui_em()});
    ImGui::TextDisabled("Taken when the loop starts anew.");
    draw_choices(controls);
    draw_fields(controls);
    ImGui::PopStyleVar();
  }
  ImGui::EndChild();
  draw_restart(controls, input, out);
}

// Below what is set, and always in sight.
void SetupView::draw_restart(Controls& controls, const PanelInput& input, PanelRequests& out) {
  const bool changed = values_of(staged_) != running_;
  if (changed) judge(input);
  ImGui::BeginDisabled(!changed || !refused_.empty());
  if (controls.button("restart", "Restart the loop with these")) out.restart = staged_;
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!changed);
  if (controls.button("setup_back", "Back")) known_ = false;
  ImGui::EndDisabled();
  const bool study = staged_.contact.study;
  if (!changed && !study) return;
  const std::string words = !refused_.empty() && changed ? refused_ : changed ? told_ : std::string{};
  const WithFont small(UiFont::small);
  ImGui::PushStyleColor(ImGuiCol_Text, changed && !refused_.empty() ? ink::kBad : ink::kWarn);
  ImGui::TextWrapped("%s",
                     words.empty() && study ? "A study: all is used as it is set, stable or not." : words.c_str());
  ImGui::PopStyleColor();
}

}  // namespace gearshift
