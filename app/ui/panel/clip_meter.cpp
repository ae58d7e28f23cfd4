#include "app/ui/panel/clip_meter.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/ui/panel/palette.h"

namespace gearshift::ui {
namespace {

glm::dvec2 wanted_force(const haptics::HapticSnapshot& snapshot) {
  return snapshot.wall_force + snapshot.feel_force + snapshot.load_force;
}

// Returns the larger component. The device limits each axis separately, so this component decides whether the force is
// clipped.
double larger_component(glm::dvec2 force) {
  return std::max(std::abs(force.x), std::abs(force.y));
}

float bar_height() {
  return 0.75f * engine::ui_em();
}

}  // namespace

void ClipMeter::push(const haptics::HapticSnapshot& snapshot) {
  record_.push(1e-9 * static_cast<double>(snapshot.time_ns), larger_component(wanted_force(snapshot)),
               (snapshot.flags & haptics::kFlagSaturated) != 0);
}

float ClipMeter::height() {
  return engine::ui_font_size(engine::UiFont::small) + bar_height() + 2.0f * ImGui::GetStyle().ItemSpacing.y;
}

// Draws a bar that spans 1.5 times the device's limit: delivered force filled, rendered force as a thick line, peak of
// the rendered force as a thin line.
void ClipMeter::draw(Controls& controls, const haptics::HapticSnapshot& now, const haptics::DeviceSpec& device) const {
  const double max = std::max(1.0, larger_component(device.max_force)), range = 1.5 * max;
  const double wanted = larger_component(wanted_force(now)), delivered = larger_component(now.f_a);
  const bool clipped = (now.flags & haptics::kFlagSaturated) != 0;
  controls.legend(ink::kActuator, fmt::format("sent {:.1f} N", delivered));
  ImGui::SameLine(0.0f, 0.8f * engine::ui_em());
  controls.legend(ink::kText, fmt::format("wanted {:.1f} N", wanted));
  ImGui::SameLine(0.0f, 0.8f * engine::ui_em());
  const double fraction = record_.fraction();
  controls.legend(fraction > 0.0 ? ink::kBad : ink::kGood, fmt::format("clipped {:.1f} %", 100.0 * fraction));

  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, bar_height());
  ImGui::Dummy(size);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("In the last 10 s, up to %.1f N was requested; the device can deliver %.1f N per axis.",
                      record_.peak(), max);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto x = [&](double force) { return low.x + size.x * static_cast<float>(std::min(force / range, 1.0)); };
  const float bottom = low.y + size.y, thick = std::max(1.0f, 0.13f * engine::ui_em());
  list.AddRectFilled(low, {low.x + size.x, bottom}, ink::kWell, 2.0f);
  list.AddRectFilled({x(max), low.y}, {low.x + size.x, bottom}, engine::with_alpha(ink::kBad, 0.25f), 2.0f);
  list.AddRectFilled(low, {x(delivered), bottom}, clipped ? ink::kBad : ink::kActuator, 2.0f);
  list.AddLine({x(wanted), low.y}, {x(wanted), bottom}, ink::kText, thick);
  list.AddLine({x(record_.peak()), low.y}, {x(record_.peak()), bottom}, ink::kWarn, 0.5f * thick);
}

}  // namespace gearshift::ui
