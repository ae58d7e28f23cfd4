#include "app/devices/stick_list.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "app/devices/known_stick.h"
#include "haptics/files/file_error.h"

namespace gearshift {
namespace {

constexpr std::uint16_t kPhysicalInterfacePage = 0x0F;

bool names_forces(const ReportDescriptor& descriptor) {
  return std::any_of(descriptor.fields.begin(), descriptor.fields.end(), [](const HidField& field) {
    return std::any_of(field.usages.begin(), field.usages.end(),
                       [](const HidUsage& usage) { return usage.page == kPhysicalInterfacePage; });
  });
}

void take_forces(const ReportDescriptor& descriptor, ListedStick& stick) {
  const std::optional<PidLayout> pid = find_pid(descriptor);
  if (!pid) {
    stick.force = names_forces(descriptor) ? StickForce::rumble : StickForce::none;
    return;
  }
  stick.force = StickForce::pushes;
  for (std::size_t i = 0; i < kPidEffects; ++i)
    if (pid->makes(static_cast<PidEffect>(i))) stick.effects.push_back(static_cast<PidEffect>(i));
}

void take_calibration(const std::filesystem::path& folder, ListedStick& stick) {
  stick.missing = missing_words({});
  try {
    const std::optional<KnownStick> known = read_known(folder, stick.identity);
    if (!known) return;
    stick.missing = missing_words(known->calibration);
    stick.calibrated = stick.missing.empty();
  } catch (const FileError& damaged) {
    if (stick.problem.empty()) stick.problem = damaged.what();
  }
}

// Nothing: no stick.
std::optional<ListedStick> listed(const UsbHidDevice& device, const std::filesystem::path& folder) {
  ListedStick stick;
  stick.identity = device.identity;
  stick.interface = device.interface;
  stick.report_descriptor = device.report_descriptor;
  stick.problem = device.problem;
  if (device.report_descriptor.empty()) return stick.problem.empty() ? std::nullopt : std::optional(stick);
  try {
    const ReportDescriptor descriptor = parse_report_descriptor(device.report_descriptor);
    const std::optional<LeverReport> lever = find_lever_report(descriptor);
    if (!lever) return std::nullopt;
    stick.axes = lever->axes.size();
    stick.buttons = lever->buttons.size();
    take_forces(descriptor, stick);
  } catch (const HidError& refused) {
    stick.problem = fmt::format("{}: {}", stick_name(stick.identity), refused.what());
    return stick;
  }
  if (stick.force == StickForce::pushes) take_calibration(folder, stick);
  return stick;
}

bool is_used(PidEffect effect) {
  return effect == PidEffect::constant || effect == PidEffect::spring || effect == PidEffect::damper;
}

}  // namespace

std::vector<ListedStick> list_sticks(std::span<const UsbHidDevice> devices, const std::filesystem::path& folder) {
  std::vector<ListedStick> sticks;
  for (const UsbHidDevice& device : devices)
    if (std::optional<ListedStick> stick = listed(device, folder)) sticks.push_back(std::move(*stick));
  return sticks;
}

std::vector<std::string> absent_problems(std::span<const ListedStick> plugged, const std::filesystem::path& folder) {
  std::vector<std::string> problems = known_sticks(folder).problems;
  std::erase_if(problems, [plugged](const std::string& problem) {
    return std::any_of(plugged.begin(), plugged.end(),
                       [&problem](const ListedStick& stick) { return stick.problem == problem; });
  });
  return problems;
}

bool is_forbidden(const ListedStick& stick) {
  return stick.problem.find("may not be used by this user") != std::string::npos;
}

std::string force_words(const ListedStick& stick) {
  switch (stick.force) {
    case StickForce::unknown:
      return "not known";
    case StickForce::none:
      return "no force feedback";
    case StickForce::rumble:
      return "rumble only";
    case StickForce::pushes:
      break;
  }
  std::string words;
  for (const PidEffect effect : stick.effects)
    if (is_used(effect)) words += (words.empty() ? "" : ", ") + std::string(pid_effect_name(effect));
  const auto others = std::count_if(stick.effects.begin(), stick.effects.end(), std::not_fn(is_used));
  return others == 0 ? words : fmt::format("{}, {} others", words, others);
}

std::string calibration_words(const ListedStick& stick) {
  if (stick.force != StickForce::pushes) return "-";
  if (stick.calibrated) return "yes";
  return stick.missing == missing_words({}) ? "no" : fmt::format("begun: {} missing", stick.missing);
}

}  // namespace gearshift
