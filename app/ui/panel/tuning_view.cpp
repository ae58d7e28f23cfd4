#include "app/ui/panel/tuning_view.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "app/ui/panel/format_value.h"
#include "app/ui/panel/palette.h"
#include "app/ui/panel/text_lines.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift::ui {
namespace {

std::string format_stable_range(const TuningField& field, const StableRange& stable) {
  const bool from_min = stable.min <= field.range.min, to_max = stable.max >= field.range.max;
  if (from_min && to_max) return "all stable";
  if (from_min) return "stable up to " + format_value(stable.max, field);
  if (to_max) return "stable from " + format_value(stable.min, field);
  return fmt::format("stable {:.{}f} to {}", stable.min, field.display.decimals, format_value(stable.max, field));
}

// Draws the stable range and the running value under the slider.
void draw_stable_bar(const TuningField& field, const StableRange& stable, double running) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = engine::ui_em(), top = high.y + 0.08f * em, bottom = top + 0.2f * em;
  const float half_grab = 0.5f * ImGui::GetStyle().GrabMinSize + 2.0f;
  const auto x = [&](double value) {
    const auto fraction = static_cast<float>((value - field.range.min) / (field.range.max - field.range.min));
    return low.x + half_grab + std::clamp(fraction, 0.0f, 1.0f) * (high.x - low.x - 2.0f * half_grab);
  };
  list.AddRectFilled({x(field.range.min), top}, {x(field.range.max), bottom}, engine::with_alpha(ink::kBad, 0.55f),
                     1.0f);
  list.AddRectFilled({x(stable.min), top}, {x(stable.max), bottom}, engine::with_alpha(ink::kGood, 0.8f), 1.0f);
  const float at = x(running);
  list.AddTriangleFilled({at, high.y - 0.05f * em}, {at + 0.28f * em, bottom + 0.12f * em},
                         {at - 0.28f * em, bottom + 0.12f * em}, ink::kText);
}

}  // namespace

bool TuningView::was_requested(const haptics::HapticTuning& tuning) const {
  const std::size_t known = std::min(request_count_, requested_.size());
  return std::find(requested_.begin(), requested_.begin() + static_cast<std::ptrdiff_t>(known), tuning) !=
         requested_.begin() + static_cast<std::ptrdiff_t>(known);
}

void TuningView::follow(const PanelInput& input) {
  const haptics::HapticTuning& runs = input.admitted.tuning;
  if (started_ && runs == running_) return;
  running_ = runs;
  if (started_ && was_requested(runs)) return;
  history_.restart(runs);
  edited_ = runs;
  started_ = true;
}

TuningQuestion TuningView::question(const PanelInput& input, const haptics::HapticTuning& tuning) const {
  TuningQuestion question{input.haptics, input.device, haptics::max_feel_stiffness(input.gate)};
  question.config.tuning = tuning;
  question.config.contact.hold = input.admitted.hold;
  return question;
}

void TuningView::request(const haptics::HapticTuning& tuning, PanelCommands& out) {
  out.push_back(ChangeTuning{tuning});
  requested_[request_count_++ % requested_.size()] = tuning;
}

void TuningView::show(const haptics::HapticTuning& tuning, const PanelInput& input, PanelCommands& out) {
  edited_ = tuning;
  same_drag_ = false;
  if (judged(input).admissible) request(tuning, out);
}

void TuningView::edit(const haptics::HapticTuning& tuning, const PanelInput& input, PanelCommands& out) {
  edited_ = tuning;
  if (!judged(input).admissible) return;
  history_.change(tuning, same_drag_);
  same_drag_ = true;
  request(tuning, out);
}

void TuningView::apply_step(Step step, const PanelInput& input, PanelCommands& out) {
  follow(input);
  switch (step) {
    case Step::undo:
      if (!is_refused(input)) history_.undo();  // if the last edit was rejected, undo only discards that edit
      break;
    case Step::redo:
      history_.redo();
      break;
    case Step::reset:
      history_.reset();
      break;
    case Step::switch_slot:
      history_.switch_slot();
      break;
  }
  show(history_.current(), input, out);
}

void TuningView::draw(Controls& controls, const PanelInput& input, PanelCommands& out) {
  follow(input);
  draw_steps(controls, input, out);
  // All ranges stay unchanged while a slider is dragged, and are updated when it is released.
  ranges_ = judge_.ranges(question(input, edited_), ImGui::IsAnyItemActive());
  for (std::size_t i = 0; i < std::size(kTuningFields); ++i) draw_field(i, controls, input, out);
  draw_verdict(controls, input, out);
}

void TuningView::draw_steps(Controls& controls, const PanelInput& input, PanelCommands& out) {
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 4.0f * gap) / 5.0f;
  const auto slot_button = [&](TuningSlot slot, const char* name, const char* label) {
    const bool on = history_.slot() == slot;
    if (controls.button(name, label, {width, 0.0f}, on ? ink::kAccentDeep : ink::kRaised) && !on)
      apply_step(Step::switch_slot, input, out);
    ImGui::SameLine();
  };
  const auto step_button = [&](Step step, const char* name, const char* label, bool possible) {
    ImGui::BeginDisabled(!possible);
    if (controls.button(name, label, {width, 0.0f})) apply_step(step, input, out);
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

void TuningView::draw_field(std::size_t index, Controls& controls, const PanelInput& input, PanelCommands& out) {
  const TuningField& field = kTuningFields[index];
  const StableRange stable = ranges_[index];
  const double running = value_of(running_, field);
  haptics::HapticTuning wanted = edited_;
  double& value = value_of(wanted, field);
  const bool bad = is_refused(input) && (value < stable.min || value > stable.max);

  ImGui::TextUnformatted(field.label);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s\nToo low: %s.\nToo high: %s.", field.description, field.too_low, field.too_high);
  put_right(format_stable_range(field, stable), bad ? ink::kBad : ink::kSoft);
  if (bad) ImGui::PushStyleColor(ImGuiCol_Text, ink::kBad);
  if (bad) ImGui::PushStyleColor(ImGuiCol_SliderGrab, ink::kBad);
  const bool changed = controls.slider(field.key, field.range, field.display, value);
  if (bad) ImGui::PopStyleColor(2);
  if (ImGui::IsItemActivated()) same_drag_ = false;
  draw_stable_bar(field, stable, running);
  ImGui::Dummy({0.0f, 0.1f * engine::ui_em()});
  if (changed) edit(wanted, input, out);
}

// Draws the result of the check of the edited values, one or two sentences.
void TuningView::draw_verdict(Controls& controls, const PanelInput& input, PanelCommands& out) {
  ImGui::Separator();
  if (is_refused(input)) {
    draw_refusal(controls, input, out);
  } else if (input.haptics.contact.allow_unstable) {
    put_wrapped("Unstable values are allowed and not limited. Keep your hands off the lever.", ink::kBad);
    for (const haptics::TuningLimit& limit : judged(input).admitted.limits)
      put_wrapped(format_limit(limit), ink::kWarn);
  } else {
    put_wrapped(fmt::format("Stable with every hand model ({}).", haptics::to_string(input.admitted.hold)), ink::kGood);
    for (const haptics::TuningLimit& limit : input.admitted.limits)
      put_wrapped("Limited when the loop started. " + format_limit(limit), ink::kWarn);
  }
}

void TuningView::draw_refusal(Controls& controls, const PanelInput& input, PanelCommands& out) {
  const TuningAnswer answered = judged(input);
  put_wrapped("Not applied. The previous values are still in use.", ink::kBad);
  if (!answered.refused.empty()) put_wrapped(answered.refused, ink::kWarn);
  for (const haptics::TuningLimit& limit : answered.admitted.limits) put_wrapped(format_limit(limit), ink::kWarn);
  if (controls.button("use_stable", "Use stable values")) {
    if (const auto stable = nearest_stable(question(input, edited_))) {
      same_drag_ = false;
      edit(*stable, input, out);
    }
  }
  ImGui::SameLine();
  if (controls.button("keep_running", "Keep previous values")) edited_ = running_;
}

}  // namespace gearshift::ui
