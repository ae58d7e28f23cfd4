#include "app/panel/setup_view.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "app/panel/palette.h"
#include "app/panel/tuning_answer.h"

namespace gearshift {
namespace {

const std::vector<std::string>& hold_names() {
  static const std::vector<std::string> names{"automatic", "zero-order", "half-sample", "observer"};
  return names;
}
const std::vector<std::string>& energy_names() {
  static const std::vector<std::string> names{"none", "energy bounding", "passivity controller"};
  return names;
}

template <class Word>
void choose(Controls& controls, const char* name, const char* label, Word& value, const std::vector<std::string>& names,
            float label_width) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(label_width);
  const auto chosen =
      controls.choice(name, names[static_cast<std::size_t>(value)], names, ImGui::GetContentRegionAvail().x);
  if (!chosen) return;
  value = static_cast<Word>(std::find(names.begin(), names.end(), *chosen) - names.begin());
}

float label_width() {
  return 9.3f * ui_em();
}

}  // namespace

SetupView::Values SetupView::values_of(const HapticConfig& config) {
  Values values{};
  for (std::size_t i = 0; i < kSetupFields.size(); ++i) values[i] = kSetupFields[i].get(config);
  values[kSetupFields.size()] = static_cast<double>(config.contact.hold);
  values[kSetupFields.size() + 1] = static_cast<double>(config.contact.energy_control);
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
  staged_.contact.study = runs.contact.study;
  staged_.contact.reversal_limiter = runs.contact.reversal_limiter;
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
  choose(controls, "hold", "Hold", staged_.contact.hold, hold_names(), label_width());
  choose(controls, "energy_control", "Energy control", staged_.contact.energy_control, energy_names(), label_width());
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
  ImGui::TextDisabled("Taken when the loop starts anew.");
  draw_choices(controls);
  draw_fields(controls);
  const bool changed = values_of(staged_) != running_;
  if (changed) judge(input);
  ImGui::BeginDisabled(!changed || !refused_.empty());
  if (controls.button("restart", "Restart the loop with these")) out.restart = staged_;
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!changed);
  if (controls.button("setup_back", "Back")) known_ = false;
  ImGui::EndDisabled();
  if (!changed) return;
  const WithFont small(UiFont::small);
  ImGui::PushStyleColor(ImGuiCol_Text, refused_.empty() ? ink::kWarn : ink::kBad);
  ImGui::TextWrapped("%s", refused_.empty() ? told_.c_str() : refused_.c_str());
  ImGui::PopStyleColor();
}

}  // namespace gearshift
