#include "app/runtime/devices/stick_lever.h"

#include <utility>

#include <fmt/format.h>

#include "haptics/hardware/pid_lever.h"

namespace gearshift::runtime {
namespace {

// Rejects a stick whose reports have changed since its calibration, for example by a firmware update: forces based on
// the old reports could push the wrong way.
haptics::PortOpener with_descriptor_check(haptics::PortOpener open, const KnownStick& stick) {
  return [open = std::move(open), stick] {
    std::unique_ptr<haptics::HidPort> port = open();
    if (port->report_descriptor() == stick.report_descriptor) return port;
    const haptics::HidIdentity identity = identity_of(stick.calibration);
    throw haptics::HidError(
        fmt::format("the report format of {} has changed since calibration; run: gearshift devices --calibrate {}",
                    stick_name(identity), stick_id(identity)));
  };
}

// Lists what a calibration of an older version did not measure, and what that costs.
std::string describe_unmeasured(const haptics::DeviceCalibration& known) {
  std::string parts;
  const auto add = [&parts](bool lacks, const char* part) {
    if (lacks) parts += (parts.empty() ? "" : ", and ") + std::string(part);
  };
  add(known.has_polarity() && !known.has_strength(), "the strength of forces, so they may be too strong or too weak");
  add(known.select.spring_sign != 0 && !known.has_springs() && known.springs_refused.empty(),
      "the springs' dead band, so springs are not used and walls are softer");
  return parts;
}

}  // namespace

StickLever::StickLever(const KnownStick& stick, haptics::PortOpener open)
    : stick_(stick),
      idle_(stick.report_descriptor),
      driver_(stick.report_descriptor, stick.calibration.style),
      connection_(driver_, with_descriptor_check(std::move(open), stick), kTickNs),
      unmeasured_(describe_unmeasured(stick.calibration)) {}

StickLever::~StickLever() = default;

std::unique_ptr<haptics::HapticDevice> StickLever::lever(double period) {
  return std::make_unique<haptics::PidLever>(stick_.calibration, driver_, period, &stop_);
}

std::unique_ptr<haptics::HapticDevice> StickLever::detached_lever(double period) {
  return std::make_unique<haptics::PidLever>(stick_.calibration, idle_, period);
}

std::optional<std::string> StickLever::take_message() {
  if (const std::string unmeasured = std::exchange(unmeasured_, {}); !unmeasured.empty()) {
    const haptics::HidIdentity identity = identity_of(stick_.calibration);
    return fmt::format("the calibration of {} lacks {}; run: gearshift devices --calibrate {}", stick_name(identity),
                       unmeasured, stick_id(identity));
  }
  const std::optional<haptics::PidAbility> ability = connection_.ability();
  if (ability && notes_reported_ < ability->notes.size()) return ability->notes[notes_reported_++];
  return connection_.take_message();
}

}  // namespace gearshift::runtime
