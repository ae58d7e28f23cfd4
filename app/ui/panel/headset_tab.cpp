#include "app/ui/panel/headset_tab.h"

#include <array>

#include <fmt/format.h>

#include "app/ui/panel/table_rows.h"
#include "app/ui/panel/text_lines.h"
#include "engine/ui/ui_style.h"

namespace gearshift::ui {
namespace {

constexpr double kMaxHeight = 0.3, kMaxDistance = 1.5;  // [m] limits of values in the seat file

const char* tracking_note(const cabin::HeadsetReport& headset) {
  if (headset.is_tracked) return "";
  return headset.orientation_only ? ", position unknown" : ", not tracked";
}

void draw_frames(const cabin::HeadsetReport& headset) {
  const engine::HeadsetTiming& t = headset.timing;
  const double rate = t.period_ms > 0.0 ? 1e3 / t.period_ms : 0.0;
  if (!ImGui::BeginTable("headset", 2, ImGuiTableFlags_SizingStretchProp)) return;
  table_row("Headset", headset.headset);
  table_row("Runtime", headset.runtime);
  table_row("State", headset.state + tracking_note(headset), headset.is_tracked ? ink::kText : ink::kWarn);
  table_row("Image", fmt::format("2 x {} x {}", headset.eye.x, headset.eye.y));
  table_row("Display", fmt::format("{:.0f} Hz, period {:.1f} ms", rate, t.period_ms));
  table_row("Frame, CPU", fmt::format("{:.1f} ms", t.cpu_ms), t.cpu_ms > t.period_ms ? ink::kWarn : ink::kText);
  table_row("Frame, GPU", fmt::format("{:.1f} ms", t.gpu_ms), t.gpu_ms > t.period_ms ? ink::kWarn : ink::kText);
  table_row("Ready",
            t.spare_ms < 0.0 ? fmt::format("{:.1f} ms too late", -t.spare_ms)
                             : fmt::format("{:.1f} ms before display", t.spare_ms),
            t.spare_ms < 0.0 ? ink::kWarn : ink::kText);
  table_row("Displayed", t.late_ms > 0.0 ? fmt::format("{:.1f} ms later than predicted", t.late_ms) : "as predicted",
            t.late_ms > 0.0 ? ink::kWarn : ink::kText);
  table_row("Dropped", fmt::format("{} of {}", t.dropped, t.dropped + t.frames),
            t.dropped > 0 ? ink::kWarn : ink::kText);
  table_row("Late", fmt::format("{} of {}", t.late, t.frames), t.late > 0 ? ink::kWarn : ink::kText);
  ImGui::EndTable();
}

// Draws a field that shows a value [m] in millimetres. Returns the new value [m] if the user changed it. `max` [m]:
// largest allowed value.
std::optional<double> length_field(Controls& controls, const char* name, const char* label, double value, double max) {
  double shown = 1e3 * value;
  const double min_mm = -1e3 * max, max_mm = 1e3 * max;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(7.0f * engine::ui_em());
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  ImGui::PushID(name);
  const bool changed = ImGui::DragScalar("##length", ImGuiDataType_Double, &shown, 1.0f, &min_mm, &max_mm, "%.0f mm",
                                         ImGuiSliderFlags_AlwaysClamp);
  ImGui::PopID();
  controls.mark(name);
  return changed ? std::optional(1e-3 * shown) : std::nullopt;
}

// `is_real`: true if the lever is a physical stick, so that its position matters.
void draw_touch_buttons(Controls& controls, const cabin::HeadsetReport& headset, bool is_real, PanelCommands& out) {
  if (controls.button("headset_touch", "Touch the knob")) out.push_back(StartTouching{});
  if (headset.is_touched) {
    ImGui::SameLine();
    if (controls.button("headset_forget", "Forget points")) out.push_back(ForgetTouches{});
    put_wrapped(fmt::format("Calibrated by touch. The drawn lever is within {:.0f} mm of the real one.",
                            1e3 * headset.touch_error),
                ink::kSoft);
  } else if (headset.seat.touched) {
    ImGui::SameLine();
    if (controls.button("headset_forget", "Forget points")) out.push_back(ForgetTouches{});
    put_wrapped("The saved touch points do not match this room. They remain saved, but are not used here.", ink::kWarn);
  } else if (is_real) {
    put_wrapped(
        "The lever's position is not calibrated and may be drawn several centimetres off. Choose \"Touch the knob\".",
        ink::kWarn);
  }
}

std::string format_touches(const cabin::HeadsetReport& headset) {
  if (headset.touches == 0) return "No points touched yet.";
  if (headset.touches == 1) return "1 point touched.";
  return fmt::format("{} points touched, up to {:.0f} mm off.", headset.touches, 1e3 * headset.worst_touch);
}

void draw_touch_instructions(Controls& controls, const cabin::HeadsetReport& headset, PanelCommands& out) {
  put_wrapped(
      "Hold the controller's tip, where its ray begins, on the centre of the knob's top and pull the trigger. Do this "
      "in neutral, then in two other gears: turn the controller sideways for one and tilt it for the other.",
      ink::kText);
  if (controls.button("headset_touched", "Save points")) out.push_back(SaveTouches{});
  ImGui::SameLine();
  if (controls.button("headset_forget", "Cancel")) out.push_back(ForgetTouches{});
  put(format_touches(headset), ink::kSoft, engine::UiFont::small);
}

void draw_seat(Controls& controls, const cabin::HeadsetReport& headset, bool is_real, PanelCommands& out) {
  const cabin::SeatSettings& seat = headset.seat;
  put("Seat", ink::kText, engine::UiFont::title);
  if (controls.button("headset_recentre", "Recentre the seat")) out.push_back(RecentreSeat{});
  if (headset.touching)
    draw_touch_instructions(controls, headset, out);
  else
    draw_touch_buttons(controls, headset, is_real, out);
  if (headset.is_touched || headset.touching) return;  // the touched points define the knob's position
  if (!seat.knob) {
    const auto height = length_field(controls, "headset_height", "Seat raised by", seat.height, kMaxHeight);
    if (height) out.push_back(SetSeatHeight{*height});
    // Initial values: the knob's position in the drawn cabin.
    const double right = seat.drive == cabin::DriveSide::left ? 0.33 : -0.33;
    if (controls.button("headset_knob", "Enter knob position")) out.push_back(SetKnob{{right, 0.51, 0.32}});
    return;
  }
  put_wrapped("Knob position relative to your eyes:", ink::kSoft);
  cabin::KnobDistance knob = *seat.knob;
  const auto field = [&](const char* name, const char* label, double& value) {
    const std::optional<double> changed = length_field(controls, name, label, value, kMaxDistance);
    if (!changed) return;
    value = *changed;
    out.push_back(SetKnob{knob});
  };
  field("headset_knob_right", "right", knob.right);
  field("headset_knob_down", "down", knob.down);
  field("headset_knob_ahead", "ahead", knob.ahead);
  if (controls.button("headset_knob", "Forget knob position")) out.push_back(ForgetKnob{});
}

}  // namespace

void draw_headset_tab(Controls& controls, const PanelInput& input, PanelCommands& out) {
  draw_frames(*input.headset);
  if (!input.headset->has_controller)
    put_wrapped("No controller that the trainer knows is in use. Use the mouse, and the panel's key for the panel.",
                ink::kSoft);
  ImGui::Spacing();
  draw_seat(controls, *input.headset, input.stick.has_value(), out);
}

}  // namespace gearshift::ui
