#include "app/panel/clip_meter.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/panel/palette.h"

namespace gearshift {
namespace {

glm::dvec2 wanted_force(const HapticSnapshot& snapshot) {
  return snapshot.wall_force + snapshot.feel_force + snapshot.world_force;
}

// The device's limit is one per axis: of the greater part.
double greater(glm::dvec2 force) {
  return std::max(std::abs(force.x), std::abs(force.y));
}

float bar_height() {
  return 0.75f * ui_em();
}

}  // namespace

void ClipMeter::push(const HapticSnapshot& snapshot) {
  record_.push(1e-9 * static_cast<double>(snapshot.time_ns), greater(wanted_force(snapshot)),
               (snapshot.flags & kFlagSaturated) != 0);
}

float ClipMeter::height() {
  return ui_font(UiFont::small)->FontSize + bar_height() + 2.0f * ImGui::GetStyle().ItemSpacing.y;
}

// A bar of one and a half times what the device can: given filled, wanted as a mark, its peak as a thin line.
void ClipMeter::draw(Controls& controls, const HapticSnapshot& now, const DeviceSpec& device) const {
  const double most = std::max(1.0, greater(device.max_force)), range = 1.5 * most;
  const double wanted = greater(wanted_force(now)), given = greater(now.f_a);
  const bool clipped = (now.flags & kFlagSaturated) != 0;
  controls.legend(ink::kActuator, fmt::format("given {:.1f} N", given));
  ImGui::SameLine(0.0f, 0.8f * ui_em());
  controls.legend(ink::kText, fmt::format("wanted {:.1f} N", wanted));
  ImGui::SameLine(0.0f, 0.8f * ui_em());
  const double share = record_.share();
  controls.legend(share > 0.0 ? ink::kBad : ink::kGood, fmt::format("clipped {:.1f} %", 100.0 * share));

  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, bar_height());
  ImGui::Dummy(size);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("Of the last 10 s. The device gives %.1f N per axis; peak wanted %.1f N.", most, record_.peak());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto x = [&](double force) { return low.x + size.x * static_cast<float>(std::min(force / range, 1.0)); };
  const float bottom = low.y + size.y, thick = std::max(1.0f, 0.13f * ui_em());
  list.AddRectFilled(low, {low.x + size.x, bottom}, ink::kWell, 2.0f);
  list.AddRectFilled({x(most), low.y}, {low.x + size.x, bottom}, with_alpha(ink::kBad, 0.25f), 2.0f);
  list.AddRectFilled(low, {x(given), bottom}, clipped ? ink::kBad : ink::kActuator, 2.0f);
  list.AddLine({x(wanted), low.y}, {x(wanted), bottom}, ink::kText, thick);
  list.AddLine({x(record_.peak()), low.y}, {x(record_.peak()), bottom}, ink::kWarn, 0.5f * thick);
}

}  // namespace gearshift
