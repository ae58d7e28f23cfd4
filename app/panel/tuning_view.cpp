#include "app/panel/tuning_view.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "app/hold_words.h"
#include "app/panel/palette.h"
#include "app/panel/text_lines.h"
#include "app/panel/value_text.h"

namespace gearshift {
namespace {

std::string stable_text(const TuningField& field, const StableRange& stable) {
  const bool from_least = stable.least <= field.least, to_most = stable.most >= field.most;
  if (from_least && to_most) return "all stable";
  if (from_least) return "stable up to " + value_text(stable.most, field);
  if (to_most) return "stable from " + value_text(stable.least, field);
  return fmt::format("stable {:.{}f} to {}", stable.least, field.decimals, value_text(stable.most, field));
}

// Under the slider: where it is stable, and what runs.
void draw_stable_bar(const TuningField& field, const StableRange& stable, double running) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = ui_em(), top = high.y + 0.08f * em, bottom = top + 0.2f * em;
  const float half_grab = 0.5f * ImGui::GetStyle().GrabMinSize + 2.0f;
  const auto x = [&](double value) {
    const auto share = static_cast<float>((value - field.least) / (field.most - field.least));
    return low.x + half_grab + std::clamp(share, 0.0f, 1.0f) * (high.x - low.x - 2.0f * half_grab);
  };
  list.AddRectFilled({x(field.least), top}, {x(field.most), bottom}, with_alpha(ink::kBad, 0.55f), 1.0f);
  list.AddRectFilled({x(stable.least), top}, {x(stable.most), bottom}, with_alpha(ink::kGood, 0.8f), 1.0f);
  const float at = x(running);
  list.AddTriangleFilled({at, high.y - 0.05f * em}, {at + 0.28f * em, bottom + 0.12f * em},
                         {at - 0.28f * em, bottom + 0.12f * em}, ink::kText);
}

}  // namespace

bool TuningView::was_asked_for(const HapticTuning& tuning) const {
  const std::size_t known = std::min(asks_, asked_for_.size());
  return std::find(asked_for_.begin(), asked_for_.begin() + static_cast<std::ptrdiff_t>(known), tuning) !=
         asked_for_.begin() + static_cast<std::ptrdiff_t>(known);
}

void TuningView::follow(const PanelInput& input) {
  const HapticTuning& runs = input.admitted.tuning;
  if (started_ && runs == running_) return;
  running_ = runs;
  if (started_ && was_asked_for(runs)) return;
  history_.restart(runs);
  edited_ = runs;
  started_ = true;
}

TuningQuestion TuningView::question(const PanelInput& input, const HapticTuning& tuning) const {
  TuningQuestion question{input.haptics, *input.device, input.gate, input.admitted.hold};
  question.config.tuning = tuning;
  return question;
}

void TuningView::request(const HapticTuning& tuning, PanelRequests& out) {
  out.tuning = tuning;
  asked_for_[asks_++ % asked_for_.size()] = tuning;
}

void TuningView::show(const HapticTuning& tuning, const PanelInput& input, PanelRequests& out) {
  edited_ = tuning;
  goes_on_ = false;
  if (judged(input).admissible) request(tuning, out);
}

void TuningView::edit(const HapticTuning& tuning, const PanelInput& input, PanelRequests& out) {
  edited_ = tuning;
  if (!judged(input).admissible) return;
  history_.change(tuning, goes_on_);
  goes_on_ = true;
  request(tuning, out);
}

void TuningView::take(Step step, const PanelInput& input, PanelRequests& out) {
  switch (step) {
    case Step::undo:
      if (!is_refused(input)) history_.undo();  // first of all what was not applied is taken back
      break;
    case Step::redo:
      history_.redo();
      break;
    case Step::reset:
      history_.reset();
      break;
    case Step::other_slot:
      history_.other_slot();
      break;
  }
  show(history_.current(), input, out);
}

void TuningView::draw(Controls& controls, const PanelInput& input, PanelRequests& out) {
  draw_steps(controls, input, out);
  // While a slider is drawn its own range stays, and the others' can wait for its end.
  ranges_ = judge_.ranges(question(input, edited_), ImGui::IsAnyItemActive());
  for (std::size_t i = 0; i < kTuningFields.size(); ++i) draw_field(i, controls, input, out);
  draw_verdict(controls, input, out);
}

void TuningView::draw_steps(Controls& controls, const PanelInput& input, PanelRequests& out) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 4.0f * gap) / 5.0f;
  const auto slot_button = [&](TuningSlot slot, const char* name, const char* label) {
    const bool on = history_.slot() == slot;
    if (controls.button(name, label, {width, 0.0f}, on ? ink::kAccentDeep : ink::kRaised) && !on)
      take(Step::other_slot, input, out);
    ImGui::SameLine();
  };
  const auto step_button = [&](Step step, const char* name, const char* label, bool possible) {
    ImGui::BeginDisabled(!possible);
    if (controls.button(name, label, {width, 0.0f})) take(step, input, out);
    ImGui::EndDisabled();
  };
  slot_button(TuningSlot::a, "slot_a", "A");
  slot_button(TuningSlot::b, "slot_b", "B");
  step_button(Step::undo, "undo", "Undo", history_.can_undo() || is_refused(input));
  ImGui::SameLine();
  step_button(Step::redo, "redo", "Redo", history_.can_redo());
  ImGui::SameLine();
  step_button(Step::reset, "reset", "Reset", true);
}

void TuningView::draw_field(std::size_t index, Controls& controls, const PanelInput& input, PanelRequests& out) {
  const TuningField& field = kTuningFields[index];
  const StableRange stable = ranges_[index];
  const double running = running_.*field.member;
  HapticTuning wanted = edited_;
  double& value = wanted.*field.member;
  const bool bad = is_refused(input) && (value < stable.least || value > stable.most);

  ImGui::TextUnformatted(field.label);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", field.says);
  put_right(stable_text(field, stable), bad ? ink::kBad : ink::kSoft);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  if (bad) ImGui::PushStyleColor(ImGuiCol_Text, ink::kBad);
  if (bad) ImGui::PushStyleColor(ImGuiCol_SliderGrab, ink::kBad);
  const std::string format = fmt::format("%.{}f {}", field.decimals, field.unit);
  const std::string id = "##" + std::string(field.key);
  const bool changed = ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &field.least, &field.most,
                                           format.c_str(), ImGuiSliderFlags_AlwaysClamp);
  if (bad) ImGui::PopStyleColor(2);
  controls.mark(field.key);
  if (ImGui::IsItemActivated()) goes_on_ = false;
  draw_stable_bar(field, stable, running);
  ImGui::Dummy({0.0f, 0.1f * ui_em()});
  if (changed) edit(wanted, input, out);
}

// What holds of what is set, in one or two sentences.
void TuningView::draw_verdict(Controls& controls, const PanelInput& input, PanelRequests& out) {
  ImGui::Separator();
  if (is_refused(input)) {
    draw_refusal(controls, input, out);
  } else if (input.haptics.contact.study) {
    put_wrapped("Study: nothing is limited to what is stable. No person may touch this lever.", ink::kBad);
    for (const Limited& limited : judged(input).admitted.limited) put_wrapped(limited_sentence(limited), ink::kWarn);
  } else {
    put_wrapped(fmt::format("Stable as it is, with every listed hand: {}.", hold_words(input.admitted.hold)),
                ink::kGood);
    for (const Limited& limited : input.admitted.limited)
      put_wrapped("Wanted at the start: " + limited_sentence(limited), ink::kWarn);
  }
}

void TuningView::draw_refusal(Controls& controls, const PanelInput& input, PanelRequests& out) {
  const TuningAnswer said = judged(input);
  put_wrapped("Not applied: what ran goes on.", ink::kBad);
  if (!said.refused.empty()) put_wrapped(said.refused, ink::kWarn);
  for (const Limited& limited : said.admitted.limited) put_wrapped(limited_sentence(limited), ink::kWarn);
  if (controls.button("use_stable", "Use what is stable")) {
    if (const auto stable = most_stable(question(input, edited_))) {
      goes_on_ = false;
      edit(*stable, input, out);
    }
  }
  ImGui::SameLine();
  if (controls.button("keep_running", "Keep what runs")) edited_ = running_;
}

}  // namespace gearshift
