#include "app/panel/headset_tab.h"

#include <array>

#include <fmt/format.h>

#include "app/panel/table_rows.h"
#include "app/panel/text_lines.h"

namespace gearshift {
namespace {

constexpr double kMostHeight = 0.3, kMostDistance = 1.5;  // [m] as the seat's file allows

const char* unseen(const HeadsetReport& headset) {
  if (headset.is_tracked) return "";
  return headset.turns_alone ? ", its place not known" : ", not tracked";
}

void draw_frames(const HeadsetReport& headset) {
  const HeadsetTiming& t = headset.timing;
  const double rate = t.period_ms > 0.0 ? 1e3 / t.period_ms : 0.0;
  if (!ImGui::BeginTable("headset", 2, ImGuiTableFlags_SizingStretchProp)) return;
  table_row("Headset", headset.headset);
  table_row("Runtime", headset.runtime);
  table_row("It is", headset.state + unseen(headset), headset.is_tracked ? ink::kText : ink::kWarn);
  table_row("Picture", fmt::format("2 x {} x {}", headset.eye.x, headset.eye.y));
  table_row("Display", fmt::format("{:.0f} Hz, period {:.1f} ms", rate, t.period_ms));
  table_row("Frame, CPU", fmt::format("{:.1f} ms", t.cpu_ms), t.cpu_ms > t.period_ms ? ink::kWarn : ink::kText);
  table_row("Frame, GPU", fmt::format("{:.1f} ms", t.gpu_ms), t.gpu_ms > t.period_ms ? ink::kWarn : ink::kText);
  table_row("Ready",
            t.spare_ms < 0.0 ? fmt::format("{:.1f} ms too late", -t.spare_ms)
                             : fmt::format("{:.1f} ms before it is seen", t.spare_ms),
            t.spare_ms < 0.0 ? ink::kWarn : ink::kText);
  table_row("Seen, at best",
            t.late_ms > 0.0 ? fmt::format("{:.1f} ms later than predicted", t.late_ms) : "as predicted",
            t.late_ms > 0.0 ? ink::kWarn : ink::kText);
  table_row("Dropped", fmt::format("{} of {}", t.dropped, t.dropped + t.frames),
            t.dropped > 0 ? ink::kWarn : ink::kText);
  table_row("Late", fmt::format("{} of {}", t.late, t.frames), t.late > 0 ? ink::kWarn : ink::kText);
  ImGui::EndTable();
}

// A length in millimetres; what was changed to, in metres.
std::optional<double> length_field(Controls& controls, const char* name, const char* label, double value, double most) {
  double shown = 1e3 * value;
  const double least = -1e3 * most, highest = 1e3 * most;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(7.0f * ui_em());
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  ImGui::PushID(name);
  const bool changed = ImGui::DragScalar("##length", ImGuiDataType_Double, &shown, 1.0f, &least, &highest, "%.0f mm",
                                         ImGuiSliderFlags_AlwaysClamp);
  ImGui::PopID();
  controls.mark(name);
  return changed ? std::optional(1e-3 * shown) : std::nullopt;
}

// is_real: a person holds a lever, which is somewhere.
void draw_touched(Controls& controls, const HeadsetReport& headset, bool is_real, HeadsetRequests& out) {
  out.touch = controls.button("headset_touch", "Touch the knob");
  if (headset.is_touched) {
    ImGui::SameLine();
    out.forget_touches = controls.button("headset_forget", "Forget it");
    put_wrapped(
        fmt::format("The lever was touched: it is seen where it is, within {:.0f} mm.", 1e3 * headset.touch_error),
        ink::kSoft);
  } else if (headset.seat.touched) {
    ImGui::SameLine();
    out.forget_touches = controls.button("headset_forget", "Forget it");
    put_wrapped("The lever was touched elsewhere: that is kept, and not used now.", ink::kWarn);
  } else if (is_real) {
    put_wrapped("The lever was not touched: it may be centimetres from where it is seen.", ink::kWarn);
  }
}

void draw_touching(Controls& controls, const HeadsetReport& headset, HeadsetRequests& out) {
  put_wrapped(
      "Hold the tip of a controller, where its ray begins, on the middle of the knob's top and pull its trigger: "
      "in neutral, then in two other gears: turned to the side in one, tilted in the other.",
      ink::kText);
  out.touched = controls.button("headset_touched", "Keep it");
  ImGui::SameLine();
  out.forget_touches = controls.button("headset_forget", "Cancel");
  put(headset.touches == 0
          ? std::string("Not touched yet.")
          : fmt::format("Touched {} times, {:.0f} mm apart at most.", headset.touches, 1e3 * headset.worst_touch),
      ink::kSoft, UiFont::small);
}

void draw_seat(Controls& controls, const HeadsetReport& headset, bool is_real, HeadsetRequests& out) {
  const SeatSettings& seat = headset.seat;
  put("Seat", ink::kText, UiFont::title);
  out.recentre = controls.button("headset_recentre", "I sit: recentre");
  if (headset.touching)
    draw_touching(controls, headset, out);
  else
    draw_touched(controls, headset, is_real, out);
  if (headset.is_touched || headset.touching) return;  // the lever says where all stands
  if (!seat.knob) {
    out.height = length_field(controls, "headset_height", "Seat raised by", seat.height, kMostHeight);
    // To begin with as in the cabin.
    const double right = seat.drive == DriveSide::left ? 0.33 : -0.33;
    if (controls.button("headset_knob", "Enter where the knob is")) out.knob = KnobDistance{right, 0.51, 0.32};
    return;
  }
  put_wrapped("The knob, from the eyes of who sits:", ink::kSoft);
  KnobDistance knob = *seat.knob;
  const auto field = [&](const char* name, const char* label, double& value) {
    const std::optional<double> changed = length_field(controls, name, label, value, kMostDistance);
    if (!changed) return;
    value = *changed;
    out.knob = knob;
  };
  field("headset_knob_right", "to the right", knob.right);
  field("headset_knob_down", "down", knob.down);
  field("headset_knob_ahead", "ahead", knob.ahead);
  out.forget_knob = controls.button("headset_knob", "Forget it");
}

}  // namespace

void draw_headset_tab(Controls& controls, const PanelInput& input, HeadsetRequests& out) {
  draw_frames(*input.headset);
  ImGui::Spacing();
  draw_seat(controls, *input.headset, input.stick.has_value(), out);
}

}  // namespace gearshift
