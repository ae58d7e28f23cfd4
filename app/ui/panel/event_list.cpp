#include "app/ui/panel/event_list.h"

#include "app/ui/panel/palette.h"
#include "haptics/loop/haptic_event.h"

namespace gearshift::ui {
namespace {

ImU32 colour_of(const haptics::HapticEvent& event) {
  switch (event.kind) {
    case haptics::EventKind::gear_engaged:
    case haptics::EventKind::gear_left:
      return ink::kText;
    case haptics::EventKind::over_push_begin:
      return ink::kBad;
    case haptics::EventKind::saturation_begin:
    case haptics::EventKind::stiffness_lowered:
      return ink::kWarn;
    case haptics::EventKind::guard_changed:
      return ink::kAccent;
    case haptics::EventKind::wall_contact:
    case haptics::EventKind::over_push_end:
    case haptics::EventKind::saturation_end:
      return ink::kSoft;
  }
  return ink::kSoft;
}

}  // namespace

void EventList::add(std::span<const haptics::HapticEvent> events) {
  for (const haptics::HapticEvent& event : events) {
    events_.push_back(event);
    if (events_.size() > kMaxEvents) events_.pop_front();
  }
}

void EventList::draw(bool push_estimated) const {
  const engine::WithFont small(engine::UiFont::small);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  auto room = static_cast<int>(ImGui::GetContentRegionAvail().y / line) - 2;
  if (room < 1 || events_.empty()) return;
  ImGui::Spacing();
  ImGui::Separator();
  for (auto event = events_.rbegin(); event != events_.rend() && room > 0; ++event, --room) {
    ImGui::TextDisabled("%8.2f s", 1e-9 * static_cast<double>(event->time_ns));
    ImGui::SameLine(5.5f * engine::ui_em());
    ImGui::PushStyleColor(ImGuiCol_Text, colour_of(*event));
    ImGui::TextUnformatted(haptics::describe(*event, push_estimated).c_str());
    ImGui::PopStyleColor();
  }
}

}  // namespace gearshift::ui
