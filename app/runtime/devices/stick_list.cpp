#include "app/runtime/devices/stick_list.h"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "app/runtime/devices/known_stick.h"
#include "haptics/files/file_error.h"

namespace gearshift::runtime {
namespace {

constexpr std::uint16_t kPhysicalInterfacePage = 0x0F;

bool names_forces(const haptics::ReportDescriptor& descriptor) {
  return std::any_of(descriptor.fields.begin(), descriptor.fields.end(), [](const haptics::HidField& field) {
    return std::any_of(field.usages.begin(), field.usages.end(),
                       [](const haptics::HidUsage& usage) { return usage.page == kPhysicalInterfacePage; });
  });
}

void read_forces(const haptics::ReportDescriptor& descriptor, ListedStick& stick) {
  const std::optional<haptics::PidLayout> pid = haptics::find_pid(descriptor);
  if (!pid) {
    stick.force = names_forces(descriptor) ? StickForce::rumble : StickForce::none;
    return;
  }
  stick.force = StickForce::force_feedback;
  for (std::size_t i = 0; i < haptics::kPidEffects; ++i)
    if (pid->has_effect(static_cast<haptics::PidEffect>(i)))
      stick.effects.push_back(static_cast<haptics::PidEffect>(i));
}

void apply_calibration(const std::filesystem::path& folder, ListedStick& stick) {
  stick.missing = describe_missing({});
  try {
    const std::optional<KnownStick> known = read_known_stick(folder, stick.identity);
    if (!known) return;
    stick.missing = describe_missing(known->calibration);
    stick.calibrated = stick.missing.empty();
  } catch (const haptics::FileError& damaged) {
    if (stick.problem.empty()) stick.problem = damaged.what();
  }
}

// Returns the list entry for the device; empty if the device is not a stick.
std::optional<ListedStick> listed(const haptics::UsbHidDevice& device, const std::filesystem::path& folder) {
  ListedStick stick;
  stick.identity = device.identity;
  stick.interface = device.interface;
  stick.report_descriptor = device.report_descriptor;
  stick.problem = device.problem;
  if (device.report_descriptor.empty()) return stick.problem.empty() ? std::nullopt : std::optional(stick);
  try {
    const haptics::ReportDescriptor descriptor = haptics::parse_report_descriptor(device.report_descriptor);
    const std::optional<haptics::LeverReport> lever = haptics::find_lever_report(descriptor);
    if (!lever) {
      read_forces(descriptor, stick);
      if (stick.force != StickForce::force_feedback) return std::nullopt;
      stick.problem = fmt::format(
          "{}: its motors cannot drive the lever, because it has no axes X and Y; without its forces it may be a "
          "pedal, "
          "a button or a lever: gearshift devices --controls",
          stick_name(stick.identity));
      return stick;
    }
    stick.axes = lever->axes.size();
    stick.buttons = lever->buttons.size();
    read_forces(descriptor, stick);
  } catch (const haptics::HidError& refused) {
    stick.problem = fmt::format("{}: {}", stick_name(stick.identity), refused.what());
    return stick;
  }
  if (stick.force == StickForce::force_feedback) apply_calibration(folder, stick);
  return stick;
}

bool is_used(haptics::PidEffect effect) {
  return effect == haptics::PidEffect::constant || effect == haptics::PidEffect::spring ||
         effect == haptics::PidEffect::damper;
}

}  // namespace

std::vector<ListedStick> list_sticks(std::span<const haptics::UsbHidDevice> devices,
                                     const std::filesystem::path& folder) {
  std::vector<ListedStick> sticks;
  for (const haptics::UsbHidDevice& device : devices)
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

bool needs_permission(const ListedStick& stick) {
  return stick.problem.find("may not be used by this user") != std::string::npos;
}

std::string describe_forces(const ListedStick& stick) {
  switch (stick.force) {
    case StickForce::unknown:
      return "unknown";
    case StickForce::none:
      return "no force feedback";
    case StickForce::rumble:
      return "rumble only";
    case StickForce::force_feedback:
      break;
  }
  std::string words;
  for (const haptics::PidEffect effect : stick.effects)
    if (is_used(effect)) words += (words.empty() ? "" : ", ") + std::string(haptics::to_string(effect));
  const auto others = std::count_if(stick.effects.begin(), stick.effects.end(), std::not_fn(is_used));
  return others == 0 ? words : fmt::format("{}, {} {}", words, others, others == 1 ? "other" : "others");
}

std::string describe_calibration(const ListedStick& stick) {
  if (stick.force != StickForce::force_feedback) return "-";
  if (stick.calibrated) return "yes";
  return stick.missing == describe_missing({}) ? "no" : fmt::format("incomplete: {} missing", stick.missing);
}

}  // namespace gearshift::runtime
