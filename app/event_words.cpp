#include "app/event_words.h"

#include <fmt/format.h>

#include "haptics/gate/gate.h"

namespace gearshift {

std::string event_words(const HapticEvent& event, bool push_estimated) {
  switch (event.kind) {
    case EventKind::gear_engaged:
      return fmt::format("{} engaged", gear_name(static_cast<int>(event.value)));
    case EventKind::gear_left:
      return fmt::format("{} left", gear_name(static_cast<int>(event.value)));
    case EventKind::wall_contact:
      return fmt::format("wall hit at {:.2f} m/s", event.value);
    case EventKind::over_push_begin:
      return fmt::format("over-push: {:.0f} N{}", event.value, push_estimated ? ", estimated" : "");
    case EventKind::over_push_end:
      return "over-push ends";
    case EventKind::saturation_begin:
      return fmt::format("saturated: {:.0f} N wanted", event.value);
    case EventKind::saturation_end:
      return "saturation ends";
    case EventKind::guard_changed:
      return fmt::format("guard: {}", guard_state_name(static_cast<GuardState>(static_cast<int>(event.value))));
    case EventKind::stiffness_lowered:
      return fmt::format("chatter: softened to {:.0f} N/m", event.value);
  }
  return "?";
}

}  // namespace gearshift
