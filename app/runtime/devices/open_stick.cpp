#include "app/runtime/devices/open_stick.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "haptics/files/ascii.h"
#include "haptics/files/printable.h"

namespace gearshift::runtime {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), haptics::ascii_lower);
  return text;
}

bool matches_exactly(const haptics::HidIdentity& stick, const std::string& wanted) {
  return lower(wanted) == stick_id(stick) || wanted == stick.serial || wanted == stick.place;
}

bool is_same_device(const ListedStick& a, const ListedStick& b) {
  return a.identity.vendor == b.identity.vendor && a.identity.product == b.identity.product &&
         a.identity.serial == b.identity.serial && a.identity.place == b.identity.place;
}

// Keeps one interface of each device: the first with forces, or the first of all if none has forces.
void keep_one_interface(std::vector<const ListedStick*>& found) {
  const std::vector<const ListedStick*> all = found;
  std::erase_if(found, [&all](const ListedStick* stick) {
    return std::any_of(all.begin(), all.end(), [stick](const ListedStick* other) {
      if (other == stick || !is_same_device(*other, *stick)) return false;
      const bool pushes = stick->force == StickForce::force_feedback;
      const bool other_pushes = other->force == StickForce::force_feedback;
      return other_pushes != pushes ? other_pushes : other->interface < stick->interface;
    });
  });
}

bool name_contains(const haptics::HidIdentity& stick, const std::string& wanted) {
  return lower(stick_name(stick)).find(lower(wanted)) != std::string::npos;
}

template <class Sticks, class Identity>
auto matching_sticks(const std::string& wanted, const Sticks& sticks, const Identity& identity) {
  std::vector<decltype(&*sticks.begin())> found;
  for (const auto& fits : {matches_exactly, name_contains}) {
    for (const auto& stick : sticks)
      if (!wanted.empty() && fits(identity(stick), wanted)) found.push_back(&stick);
    if (!found.empty()) break;
  }
  return found;
}

std::string describe_stick(const haptics::HidIdentity& stick) {
  std::string words = fmt::format("{} ({}", stick_name(stick), stick_id(stick));
  if (!stick.serial.empty()) words += ", serial " + stick.serial;
  if (!stick.place.empty()) words += ", at " + stick.place;
  return words + ")";
}

template <class Sticks, class Identity>
std::string describe_sticks(const Sticks& sticks, const Identity& identity) {
  std::string words;
  for (const auto& stick : sticks) words += (words.empty() ? "" : "; ") + describe_stick(identity(stick));
  return words;
}

const haptics::HidIdentity& listed_identity(const ListedStick& stick) {
  return stick.identity;
}

[[noreturn]] void refuse_several(const std::string& wanted, const std::string& which) {
  throw std::runtime_error(fmt::format("\"{}\" matches several sticks; choose one by its serial or port: {}",
                                       haptics::printable(wanted), which));
}

[[noreturn]] void refuse_absent(const std::string& wanted, std::span<const ListedStick> plugged) {
  const std::string none = fmt::format("no stick that matches \"{}\" is plugged in", haptics::printable(wanted));
  if (plugged.empty()) throw std::runtime_error(none + "; no other stick was found");
  throw std::runtime_error(fmt::format("{}; available sticks: {}", none, describe_sticks(plugged, listed_identity)));
}

// Searches the saved calibrations for a stick that is not plugged in. Empty: none matches.
std::optional<KnownStick> absent_stick(const std::string& wanted, const std::filesystem::path& folder) {
  const std::vector<KnownStick> known = known_sticks(folder).sticks;
  const auto identity = [](const KnownStick& stick) { return identity_of(stick.calibration); };
  const std::vector<const KnownStick*> found = matching_sticks(wanted, known, identity);
  if (found.empty()) return std::nullopt;
  std::vector<KnownStick> candidates;
  for (const KnownStick* stick : found) candidates.push_back(*stick);
  if (candidates.size() > 1) refuse_several(wanted, describe_sticks(candidates, identity));
  return candidates.front();
}

void check_calibrated(const haptics::DeviceCalibration& calibration) {
  const std::string missing = describe_missing(calibration);
  if (missing.empty()) return;
  const haptics::HidIdentity stick = identity_of(calibration);
  throw std::runtime_error(fmt::format("{} is not calibrated yet ({} missing); run: gearshift devices --calibrate {}",
                                       stick_name(stick), missing, stick_id(stick)));
}

// The stick's identity, normally without the USB port, so that the stick may be replugged at a different port. The
// identity contains the port if the user named the stick by its port, or if an identical stick is plugged in.
haptics::HidIdentity identity_to_open(const ListedStick& stick, const std::string& wanted,
                                      std::span<const ListedStick> plugged) {
  const auto is_same = [&stick](const ListedStick& other) {
    return other.identity.vendor == stick.identity.vendor && other.identity.product == stick.identity.product &&
           other.identity.serial == stick.identity.serial && other.identity.place != stick.identity.place;
  };
  haptics::HidIdentity identity = stick.identity;
  const bool has_twin = std::any_of(plugged.begin(), plugged.end(), is_same);
  if (!has_twin && wanted != identity.place) identity.place.clear();
  return identity;
}

// Opens the interface whose reports are those of the calibration; one of a stick that was not plugged in is not known
// before.
std::unique_ptr<haptics::HidPort> open_known(const haptics::HidIdentity& identity, const KnownStick& known) {
  for (const haptics::UsbHidDevice& device : haptics::usb_hid_devices()) {
    const bool is_it = device.identity.vendor == identity.vendor && device.identity.product == identity.product &&
                       device.report_descriptor == known.report_descriptor;
    if (is_it) return haptics::open_usb_hid(identity, device.interface);
  }
  return haptics::open_usb_hid(identity);
}

}  // namespace

const ListedStick* find_plugged_stick(const std::string& wanted, std::span<const ListedStick> plugged) {
  std::vector<const ListedStick*> found = matching_sticks(wanted, plugged, listed_identity);
  keep_one_interface(found);
  if (found.size() < 2) return found.empty() ? nullptr : found.front();
  std::vector<ListedStick> candidates;
  for (const ListedStick* stick : found) candidates.push_back(*stick);
  refuse_several(wanted, describe_sticks(candidates, listed_identity));
}

void check_has_forces(const ListedStick& stick) {
  if (!stick.problem.empty()) throw std::runtime_error(stick.problem);
  if (stick.force != StickForce::force_feedback)
    throw std::runtime_error(
        fmt::format("{} cannot be used with --device ({}); use this stick without --device, like a gamepad",
                    stick_name(stick.identity), describe_forces(stick)));
}

const ListedStick& select_stick(const std::string& wanted, std::span<const ListedStick> plugged) {
  const ListedStick* stick = find_plugged_stick(wanted, plugged);
  if (stick == nullptr) refuse_absent(wanted, plugged);
  return *stick;
}

ResolvedStick resolve_stick(const std::string& wanted, std::span<const ListedStick> plugged,
                            const std::filesystem::path& folder) {
  ResolvedStick chosen;
  if (const ListedStick* stick = find_plugged_stick(wanted, plugged)) {
    check_has_forces(*stick);
    chosen.identity = identity_to_open(*stick, wanted, plugged);
    chosen.interface = stick->interface;
    haptics::DeviceCalibration nothing;
    nothing.vendor = stick->identity.vendor;
    nothing.product = stick->identity.product;
    nothing.name = stick->identity.name;
    chosen.known = read_known_stick(folder, stick->identity).value_or(KnownStick{nothing, {}});
    if (chosen.known.report_descriptor.empty()) chosen.known.report_descriptor = stick->report_descriptor;
  } else {
    const std::optional<KnownStick> absent = absent_stick(wanted, folder);
    if (!absent || absent->report_descriptor.empty()) refuse_absent(wanted, plugged);
    chosen.identity = identity_of(absent->calibration);
    chosen.known = *absent;
  }
  check_calibrated(chosen.known.calibration);
  return chosen;
}

std::shared_ptr<StickLever> open_stick(const std::string& wanted, const std::filesystem::path& folder) {
  const ResolvedStick stick = resolve_stick(wanted, list_sticks(haptics::usb_hid_devices(), folder), folder);
  const auto open = [stick] {
    return stick.interface == haptics::kFirstInterface ? open_known(stick.identity, stick.known)
                                                       : haptics::open_usb_hid(stick.identity, stick.interface);
  };
  return std::make_shared<StickLever>(stick.known, open);
}

}  // namespace gearshift::runtime
