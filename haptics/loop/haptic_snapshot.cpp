#include "haptics/loop/haptic_snapshot.h"

#include "haptics/files/number_text.h"
#include "haptics/gate/gate.h"

namespace gearshift::haptics {

std::string describe(const HapticEvent& event, bool push_estimated) {
  switch (event.kind) {
    case EventKind::gear_engaged:
      return gear_name(static_cast<int>(event.value)) + std::string(" engaged");
    case EventKind::gear_left:
      return gear_name(static_cast<int>(event.value)) + std::string(" disengaged");
    case EventKind::wall_contact:
      return "wall hit at " + fixed_text(event.value, 2) + " m/s";
    case EventKind::over_push_begin:
      return "over-push: " + fixed_text(event.value, 0) + (push_estimated ? " N, estimated" : " N");
    case EventKind::over_push_end:
      return "over-push ended";
    case EventKind::saturation_begin:
      return "saturated: " + fixed_text(event.value, 0) + " N requested";
    case EventKind::saturation_end:
      return "saturation ended";
    case EventKind::guard_changed:
      return describe(static_cast<GuardState>(static_cast<int>(event.value)));
    case EventKind::stiffness_lowered:
      return "chatter: wall softened to " + fixed_text(event.value, 0) + " N/m";
  }
  return "?";
}

}  // namespace gearshift::haptics
