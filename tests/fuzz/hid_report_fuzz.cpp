// Fuzzes a device's reports, with a layout from tests/data/hid. A report must be rejected, or be decoded exactly as its
// bits define it. The first byte of the input selects the device; the rest is the report.
#include <algorithm>
#include <iterator>
#include <vector>

#include "haptics/hid/lever_report.h"
#include "haptics/hid/pid_report.h"
#include "tests/fuzz/fuzz_checks.h"
#include "tests/haptics/hid/descriptors.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

struct Device {
  LeverReport lever;
  PidLayout pid;
};

std::vector<Device> known_devices() {
  std::vector<Device> devices;
  for (const char* name : kPidDevices) {
    const ReportDescriptor descriptor = parse_report_descriptor(device_descriptor(name));
    const auto lever = find_lever_report(descriptor);
    const auto pid = find_pid(descriptor);
    check_invariant(lever && pid, "a force-feedback stick is one");
    devices.push_back({*lever, *pid});
  }
  return devices;
}

// Decodes a field bit by bit, as HID 1.11 section 8.4 defines it. Bit 0 is the lowest bit of the first byte after the
// ID. A field that the report does not contain is 0, as in Linux.
bool has_bits(std::span<const std::uint8_t> report, const BitField& field) {
  return 8 + field.offset + field.bits <= static_cast<int>(8 * report.size());
}

std::int64_t slow_bits(std::span<const std::uint8_t> report, const BitField& field) {
  if (!has_bits(report, field)) return 0;
  std::int64_t value = 0;
  for (int i = 0; i < field.bits; ++i) {
    const int at = 8 + field.offset + i;
    const std::int64_t bit = report[static_cast<std::size_t>(at / 8)] >> (at % 8) & 1;
    value += (i == field.bits - 1 && field.min < 0 ? -bit : bit) * (std::int64_t{1} << i);
  }
  return value;
}

bool slow_flag(std::span<const std::uint8_t> report, const BitField& field, bool default_value) {
  return field.exists() ? slow_bits(report, field) != 0 : default_value;
}

// `needed`: the last field without which the report says nothing
bool is_report(std::span<const std::uint8_t> report, const PidReport& layout, const BitField& needed) {
  return layout.exists() && !report.empty() && report[0] == layout.id && (!needed.exists() || has_bits(report, needed));
}

void check_lever(const LeverReport& layout, std::span<const std::uint8_t> report) {
  const auto counts = decode_lever(layout, report);
  const bool has_both = std::ranges::all_of(layout.axes, [&](const HidAxis& axis) {
    return (axis.usage != kUsageX && axis.usage != kUsageY) || has_bits(report, axis.field);
  });
  check_invariant(counts.has_value() == (!report.empty() && report[0] == layout.id && has_both),
                  "a lever's report is identified by its ID, and has X and Y");
  if (!counts) return;
  for (std::size_t i = 0; i < layout.axes.size(); ++i) {
    check_invariant(counts->axis[i] == slow_bits(report, layout.axes[i].field), "an axis is decoded correctly");
  }
  for (std::size_t i = 0; i < layout.buttons.size(); ++i) {
    const bool is_down = (counts->buttons >> i & 1) != 0;
    check_invariant(is_down == slow_flag(report, layout.buttons[i], false), "a button is decoded correctly");
  }
}

void check_state(const PidLayout& pid, std::span<const std::uint8_t> report) {
  const PidState& layout = pid.state;
  const auto state = decode_state(pid, report);
  check_invariant(state.has_value() == is_report(report, layout, layout.actuators_enabled),
                  "a state report is identified by its ID");
  if (!state) return;
  check_invariant(state->actuators_enabled == slow_flag(report, layout.actuators_enabled, false),
                  "motors are decoded correctly");
  check_invariant(state->actuator_power == slow_flag(report, layout.actuator_power, true),
                  "power is decoded correctly");
  check_invariant(state->safety_switch == slow_flag(report, layout.safety_switch, true),
                  "the safety switch is decoded correctly");
  check_invariant(state->paused == slow_flag(report, layout.paused, false), "paused is decoded correctly");
  check_invariant(state->playing == slow_flag(report, layout.playing, false), "playing is decoded correctly");
}

void check_responses(const PidLayout& pid, std::span<const std::uint8_t> report) {
  const auto load = decode_block_load(pid, report);
  check_invariant(load.has_value() == is_report(report, pid.block_load, pid.block_load.block),
                  "a load report is identified by its ID");
  if (load && pid.block_load.block.exists())
    check_invariant(load->block == std::clamp<std::int64_t>(slow_bits(report, pid.block_load.block), 0, 0xffff),
                    "a block as it stands");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer requires this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<Device> devices = known_devices();
  if (size == 0) return 0;
  const Device& device = devices[data[0] % devices.size()];
  const std::span<const std::uint8_t> report(data + 1, size - 1);
  check_lever(device.lever, report);
  check_state(device.pid, report);
  check_responses(device.pid, report);
  return 0;
}
