#include "app/devices/open_stick.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "haptics/files/ascii.h"
#include "haptics/files/printable.h"

namespace gearshift {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), ascii_lower);
  return text;
}

bool is_called(const HidIdentity& stick, const std::string& wanted) {
  return lower(wanted) == stick_id(stick) || wanted == stick.serial || wanted == stick.place;
}

bool has_in_name(const HidIdentity& stick, const std::string& wanted) {
  return lower(stick_name(stick)).find(lower(wanted)) != std::string::npos;
}

template <class Sticks, class Identity>
auto meant(const std::string& wanted, const Sticks& sticks, const Identity& identity) {
  std::vector<decltype(&*sticks.begin())> found;
  for (const auto& fits : {is_called, has_in_name}) {
    for (const auto& stick : sticks)
      if (!wanted.empty() && fits(identity(stick), wanted)) found.push_back(&stick);
    if (!found.empty()) break;
  }
  return found;
}

std::string place_words(const HidIdentity& stick) {
  std::string words = fmt::format("{} ({}", stick_name(stick), stick_id(stick));
  if (!stick.serial.empty()) words += ", serial " + stick.serial;
  if (!stick.place.empty()) words += ", at " + stick.place;
  return words + ")";
}

template <class Sticks, class Identity>
std::string all_words(const Sticks& sticks, const Identity& identity) {
  std::string words;
  for (const auto& stick : sticks) words += (words.empty() ? "" : "; ") + place_words(identity(stick));
  return words;
}

const HidIdentity& listed_identity(const ListedStick& stick) {
  return stick.identity;
}

[[noreturn]] void refuse_several(const std::string& wanted, const std::string& which) {
  throw std::runtime_error(
      fmt::format("\"{}\" may be several sticks, say which by serial or place: {}", printable(wanted), which));
}

[[noreturn]] void refuse_absent(const std::string& wanted, std::span<const ListedStick> plugged) {
  const std::string none = fmt::format("no stick \"{}\" is plugged in", printable(wanted));
  if (plugged.empty()) throw std::runtime_error(none + ", nor any other");
  throw std::runtime_error(fmt::format("{}; these are: {}", none, all_words(plugged, listed_identity)));
}

// One that was unplugged, and is waited for.
std::optional<KnownStick> absent_stick(const std::string& wanted, const std::filesystem::path& folder) {
  const std::vector<KnownStick> known = known_sticks(folder).sticks;
  const auto identity = [](const KnownStick& stick) { return identity_of(stick.calibration); };
  const std::vector<const KnownStick*> found = meant(wanted, known, identity);
  if (found.empty()) return std::nullopt;
  std::vector<KnownStick> candidates;
  for (const KnownStick* stick : found) candidates.push_back(*stick);
  if (candidates.size() > 1) refuse_several(wanted, all_words(candidates, identity));
  return candidates.front();
}

void check_calibrated(const DeviceCalibration& calibration) {
  const std::string missing = missing_words(calibration);
  if (missing.empty()) return;
  const HidIdentity stick = identity_of(calibration);
  throw std::runtime_error(fmt::format("{} is not calibrated yet ({} missing): gearshift devices --calibrate {}",
                                       stick_name(stick), missing, stick_id(stick)));
}

// Anywhere, unless only its place tells it from another one.
HidIdentity to_open(const ListedStick& stick, const std::string& wanted, std::span<const ListedStick> plugged) {
  const auto is_same = [&stick](const ListedStick& other) {
    return other.identity.vendor == stick.identity.vendor && other.identity.product == stick.identity.product &&
           other.identity.serial == stick.identity.serial;
  };
  HidIdentity identity = stick.identity;
  const bool has_twin = std::count_if(plugged.begin(), plugged.end(), is_same) > 1;
  if (!has_twin && wanted != identity.place) identity.place.clear();
  return identity;
}

}  // namespace

const ListedStick* found_stick(const std::string& wanted, std::span<const ListedStick> plugged) {
  const std::vector<const ListedStick*> found = meant(wanted, plugged, listed_identity);
  if (found.size() < 2) return found.empty() ? nullptr : found.front();
  std::vector<ListedStick> candidates;
  for (const ListedStick* stick : found) candidates.push_back(*stick);
  refuse_several(wanted, all_words(candidates, listed_identity));
}

void check_can_push(const ListedStick& stick) {
  if (!stick.problem.empty()) throw std::runtime_error(stick.problem);
  if (stick.force != StickForce::pushes)
    throw std::runtime_error(fmt::format("{} cannot push a lever ({}): without --device it drives as pads do",
                                         stick_name(stick.identity), force_words(stick)));
}

const ListedStick& chosen_stick(const std::string& wanted, std::span<const ListedStick> plugged) {
  const ListedStick* stick = found_stick(wanted, plugged);
  if (stick == nullptr) refuse_absent(wanted, plugged);
  return *stick;
}

WantedStick wanted_stick(const std::string& wanted, std::span<const ListedStick> plugged,
                         const std::filesystem::path& folder) {
  WantedStick chosen;
  if (const ListedStick* stick = found_stick(wanted, plugged)) {
    check_can_push(*stick);
    chosen.identity = to_open(*stick, wanted, plugged);
    chosen.interface = stick->interface;
    DeviceCalibration nothing;
    nothing.vendor = stick->identity.vendor;
    nothing.product = stick->identity.product;
    nothing.name = stick->identity.name;
    chosen.known = read_known(folder, stick->identity).value_or(KnownStick{nothing, {}});
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
  const WantedStick stick = wanted_stick(wanted, list_sticks(usb_hid_devices(), folder), folder);
  const auto open = [identity = stick.identity, interface = stick.interface] {
    return open_usb_hid(identity, interface);
  };
  return std::make_shared<StickLever>(stick.known, open);
}

}  // namespace gearshift
