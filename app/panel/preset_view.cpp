#include "app/panel/preset_view.h"

#include <fmt/format.h>

#include "app/energy_words.h"
#include "app/hold_words.h"
#include "app/panel/palette.h"
#include "app/panel/setup_fields.h"
#include "app/panel/tuning_fields.h"
#include "app/panel/value_text.h"

namespace gearshift {
namespace {

// One line of the comparison; same lines are counted and not drawn.
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

const char* yes_or_no(bool yes) {
  return yes ? "yes" : "no";
}

void draw_rows(Difference& rows, const HapticConfig& here, const HapticConfig& there) {
  for (const TuningField& f : kTuningFields)
    rows.row(f.label, value_text(here.tuning.*f.member, f), value_text(there.tuning.*f.member, f));
  for (const SetupField& f : kSetupFields) {
    rows.row(f.label, value_text(f.factor * f.get(here), f.unit, f.decimals),
             value_text(f.factor * f.get(there), f.unit, f.decimals));
  }
  rows.row("Hold", hold_words(here.contact.hold), hold_words(there.contact.hold));
  rows.row("Energy control", energy_words(here.contact.energy_control), energy_words(there.contact.energy_control));
  rows.row("Reversal limiter", yes_or_no(here.contact.reversal_limiter), yes_or_no(there.contact.reversal_limiter));
  rows.row("Study", yes_or_no(here.contact.study), yes_or_no(there.contact.study));
}

void draw_difference(const PanelInput& input) {
  HapticConfig here = input.haptics;
  here.tuning = input.admitted.tuning;
  Difference rows;
  const WithFont small(UiFont::small);
  if (ImGui::BeginTable("difference", 3, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH)) {
    ImGui::TableSetupColumn("");
    ImGui::TableSetupColumn("runs");
    ImGui::TableSetupColumn("preset");
    ImGui::TableHeadersRow();
    draw_rows(rows, here, input.compared->haptics);
    ImGui::EndTable();
  }
  ImGui::TextDisabled("%d differ, %d are the same", rows.different(), rows.same());
}

}  // namespace

void PresetView::draw(Controls& controls, const PanelInput& input, PanelRequests& out) {
  draw_save(controls, out);
  ImGui::Spacing();
  ImGui::Separator();
  draw_compare(controls, input, out);
}

void PresetView::draw_save(Controls& controls, PanelRequests& out) {
  ImGui::TextUnformatted("Save what runs as");
  const float button = 4.5f * ui_em();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x);
  const bool entered = ImGui::InputTextWithHint("##save_name", "a name", name_.data(), name_.size(),
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  controls.mark("save_name");
  ImGui::SameLine();
  const bool empty = name_.front() == '\0';
  ImGui::BeginDisabled(empty);
  const bool pressed = controls.button("save", "Save", {button, 0.0f});
  ImGui::EndDisabled();
  if ((entered || pressed) && !empty) out.save_preset = name_.data();
}

void PresetView::draw_compare(Controls& controls, const PanelInput& input, PanelRequests& out) {
  ImGui::TextUnformatted("Compare what runs with");
  const auto chosen = controls.choice("compare", compared_.empty() ? "a preset" : compared_, input.presets,
                                      ImGui::GetContentRegionAvail().x);
  if (chosen) out.compare = compared_ = *chosen;
  if (!compared_.empty() && input.compared) draw_difference(input);
}

}  // namespace gearshift
