// Fuzzes a device's reports, with a layout from tests/data/hid: a report is rejected, or decoded exactly as its bits
// say. The first byte selects the device; the rest is the report.
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
    hold(lever && pid, "a force-feedback stick is one");
    devices.push_back({*lever, *pid});
  }
  return devices;
}

// The definition, bit by bit: HID 1.11, 8.4. Bit 0 is the lowest of the first byte after the ID.
std::int64_t slow_bits(std::span<const std::uint8_t> report, const BitField& field) {
  std::int64_t value = 0;
  for (int i = 0; i < field.bits; ++i) {
    const int at = 8 + field.offset + i;
    const std::int64_t bit = report[static_cast<std::size_t>(at / 8)] >> (at % 8) & 1;
    value += (i == field.bits - 1 && field.min < 0 ? -bit : bit) * (std::int64_t{1} << i);
  }
  return value;
}

bool slow_flag(std::span<const std::uint8_t> report, const BitField& field, bool otherwise) {
  return field.exists() ? slow_bits(report, field) != 0 : otherwise;
}

bool is_report(std::span<const std::uint8_t> report, std::uint8_t id, std::size_t size) {
  return size > 0 && report.size() == size && report[0] == id;
}

void check_lever(const LeverReport& layout, std::span<const std::uint8_t> report) {
  const auto counts = decode_lever(layout, report);
  hold(counts.has_value() == is_report(report, layout.id, layout.size),
       "a lever's report is identified by ID and length");
  if (!counts) return;
  for (std::size_t i = 0; i < layout.axes.size(); ++i) {
    hold(counts->axis[i] == slow_bits(report, layout.axes[i].field), "an axis is decoded correctly");
  }
  for (std::size_t i = 0; i < layout.buttons.size(); ++i) {
    const bool is_down = (counts->buttons >> i & 1) != 0;
    hold(is_down == slow_flag(report, layout.buttons[i], false), "a button is decoded correctly");
  }
}

void check_state(const PidLayout& pid, std::span<const std::uint8_t> report) {
  const PidState& layout = pid.state;
  const auto state = decode_state(pid, report);
  hold(state.has_value() == is_report(report, layout.id, layout.size), "a state report is identified by ID and length");
  if (!state) return;
  hold(state->actuators_enabled == slow_flag(report, layout.actuators_enabled, false), "motors are decoded correctly");
  hold(state->actuator_power == slow_flag(report, layout.actuator_power, true), "power is decoded correctly");
  hold(state->safety_switch == slow_flag(report, layout.safety_switch, true), "the safety switch is decoded correctly");
  hold(state->paused == slow_flag(report, layout.paused, false), "paused is decoded correctly");
  hold(state->playing == slow_flag(report, layout.playing, false), "playing is decoded correctly");
}

void check_answers(const PidLayout& pid, std::span<const std::uint8_t> report) {
  const auto load = decode_block_load(pid, report);
  hold(load.has_value() == is_report(report, pid.block_load.id, pid.block_load.size),
       "a load report is identified by ID and length");
  if (load && pid.block_load.block.exists())
    hold(load->block == std::clamp<std::int64_t>(slow_bits(report, pid.block_load.block), 0, 0xffff),
         "a block as it stands");
  const auto pool = decode_pool(pid, report);
  hold(pool.has_value() == is_report(report, pid.pool.id, pid.pool.size),
       "a pool report is identified by ID and length");
  if (pool && pid.pool.ram_size.exists())
    hold(pool->ram == slow_bits(report, pid.pool.ram_size), "memory is decoded correctly");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer gives the name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<Device> devices = known_devices();
  if (size == 0) return 0;
  const Device& device = devices[data[0] % devices.size()];
  const std::span<const std::uint8_t> report(data + 1, size - 1);
  check_lever(device.lever, report);
  check_state(device.pid, report);
  check_answers(device.pid, report);
  return 0;
}
