#include "app/devices/stick_lever.h"

#include <utility>

#include <fmt/format.h>

#include "haptics/hardware/pid_lever.h"

namespace gearshift {
namespace {

// Another firmware has other reports: what was measured of the old one may push the wrong way.
PortOpener as_calibrated(PortOpener open, const KnownStick& stick) {
  return [open = std::move(open), stick] {
    std::unique_ptr<HidPort> port = open();
    if (port->report_descriptor() == stick.report_descriptor) return port;
    const HidIdentity identity = identity_of(stick.calibration);
    throw HidError(fmt::format("{} reports otherwise than when it was calibrated: gearshift devices --calibrate {}",
                               stick_name(identity), stick_id(identity)));
  };
}

}  // namespace

StickLever::StickLever(const KnownStick& stick, PortOpener open)
    : stick_(stick),
      idle_(stick.report_descriptor),
      driver_(stick.report_descriptor),
      keeper_(driver_, as_calibrated(std::move(open), stick), kTickNs) {}

StickLever::~StickLever() = default;

std::unique_ptr<HapticDevice> StickLever::lever(double period) {
  return std::make_unique<PidLever>(stick_.calibration, driver_, period);
}

std::unique_ptr<HapticDevice> StickLever::stand_in(double period) {
  return std::make_unique<PidLever>(stick_.calibration, idle_, period);
}

std::optional<std::string> StickLever::take_news() {
  const std::optional<PidAbility> ability = keeper_.ability();
  if (ability && notes_told_ < ability->notes.size()) return ability->notes[notes_told_++];
  return keeper_.take_news();
}

}  // namespace gearshift
