#include "app/panel/event_list.h"

#include "app/event_words.h"
#include "app/panel/palette.h"

namespace gearshift {
namespace {

ImU32 colour_of(const HapticEvent& event) {
  switch (event.kind) {
    case EventKind::gear_engaged:
    case EventKind::gear_left:
      return ink::kText;
    case EventKind::over_push_begin:
      return ink::kBad;
    case EventKind::saturation_begin:
    case EventKind::stiffness_lowered:
      return ink::kWarn;
    case EventKind::guard_changed:
      return ink::kAccent;
    case EventKind::wall_contact:
    case EventKind::over_push_end:
    case EventKind::saturation_end:
      return ink::kSoft;
  }
  return ink::kSoft;
}

}  // namespace

void EventList::take(std::span<const HapticEvent> events) {
  for (const HapticEvent& event : events) {
    events_.push_back(event);
    if (events_.size() > kMost) events_.pop_front();
  }
}

void EventList::draw(bool push_estimated) const {
  const WithFont small(UiFont::small);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  auto room = static_cast<int>(ImGui::GetContentRegionAvail().y / line) - 2;
  if (room < 1 || events_.empty()) return;
  ImGui::Spacing();
  ImGui::Separator();
  for (auto event = events_.rbegin(); event != events_.rend() && room > 0; ++event, --room) {
    ImGui::TextDisabled("%8.2f s", 1e-9 * static_cast<double>(event->time_ns));
    ImGui::SameLine(5.5f * ui_em());
    ImGui::PushStyleColor(ImGuiCol_Text, colour_of(*event));
    ImGui::TextUnformatted(event_words(*event, push_estimated).c_str());
    ImGui::PopStyleColor();
  }
}

}  // namespace gearshift
