// This work is based on:
// USB Implementers' Forum. Device Class Definition for Physical Interface Devices (PID), version 1.0. 1999
// and on the report descriptors of tests/data/hid, read by hand.
#include "tests/support/stick/stick_family.h"

#include <array>
#include <fstream>
#include <ios>
#include <stdexcept>
#include <string>

namespace gearshift::test {
namespace {

constexpr StickNumber u8(std::size_t at) {
  return {at, 1, false};
}
constexpr StickNumber u16(std::size_t at) {
  return {at, 2, false};
}
constexpr StickNumber s16(std::size_t at) {
  return {at, 2, true};
}

// Byte offsets: 1 block, 2 type, 3 duration, 5 trigger repeat, 7 sample period, 9 gain, 10 trigger button, 11 axes, 12
// and 13 directions (one byte each), 14 start delay.
SetEffectBytes short_set_effect() {
  return {{0x01, 16}, u16(3), u16(14), 9, 11, u8(12), u8(13), 256.0};
}

// In this longer report the start delay comes before the gain, directions have two bytes, and two type-specific offsets
// are at the end.
SetEffectBytes long_set_effect(std::uint8_t id, double full_turn) {
  return {{id, 22}, u16(3), u16(9), 11, 13, u16(14), u16(16), full_turn};
}

ConditionBytes short_condition() {
  const auto s8 = [](std::size_t at) { return StickFraction{{at, 1, true}, 127.0, -128.0}; };
  const auto fraction = [](std::size_t at) { return StickFraction{u8(at), 255.0}; };
  return {{0x03, 9}, s8(3), s8(4), s8(5), fraction(6), fraction(7), fraction(8)};
}

ConditionBytes long_condition(std::uint8_t id, double max, double min) {
  const auto signed_fraction = [&](std::size_t at) { return StickFraction{s16(at), max, min}; };
  const auto fraction = [&](std::size_t at) { return StickFraction{u16(at), max}; };
  return {{id, 15},    signed_fraction(3), signed_fraction(5), signed_fraction(7),
          fraction(9), fraction(11),       fraction(13)};
}

StickFamilyTable sidewinder() {
  StickFamilyTable table{};
  table.name = "sidewinder";
  table.vendor = 0x045e;
  table.product = 0x001b;
  table.usb_version = 0x0110;
  table.device_version = 0x0100;
  table.maker = "Microsoft";
  table.product_name = "SideWinder Force Feedback 2 Joystick";
  table.serial = "";
  table.endpoint_in = 0x81;
  table.endpoint_out = 0x02;
  table.lever = {{0x01, 13}, s16(1), s16(3), -512.0, 511.0, 10, 8, 7};
  table.state = {0x02, 3};
  table.set_effect = short_set_effect();
  table.condition = short_condition();
  table.constant = {{0x05, 4}, {s16(2), 255.0, -255.0}};
  table.operation = {0x0A, 4};
  table.block_free = {0x0B, 2};
  table.control = {0x0C, 2};
  table.gain = {0x0D, 2};
  table.other_outputs = {{0x02, 8}, {0x04, 7}, {0x06, 4}, {0x07, 16}, {0x08, 3}, {0x0E, 5}};
  table.create = {0x01, 4};
  table.block_load = {0x02, 5};
  table.pool = {0x03, 5};
  table.last_type = 12;
  table.quirks.first_block = 2;
  return table;
}

StickFamilyTable openffboard() {
  StickFamilyTable table{};
  table.name = "openffboard";
  table.vendor = 0x1209;
  table.product = 0xffb0;
  table.usb_version = 0x0200;
  table.device_version = 0x0100;
  table.maker = "Open FFBoard";
  table.product_name = "FFBoard";
  table.serial = "EMULATED01";
  table.endpoint_in = 0x83;
  table.endpoint_out = 0x02;
  table.lever = {{0x01, 25}, s16(9), s16(11), -32767.0, 32767.0, 16, 1, 0};
  table.state = {0x02, 2};
  table.set_effect = long_set_effect(0x01, 36000.0);
  table.condition = long_condition(0x03, 32767.0, -32768.0);
  table.constant = {{0x05, 4}, {s16(2), 32767.0, -32767.0}};
  table.operation = {0x0A, 4};
  table.block_free = {0x0B, 2};
  table.control = {0x0C, 2};
  table.gain = {0x0D, 2};
  table.other_outputs = {{0x02, 14}, {0x04, 12}, {0x06, 6}, {0xA1, 25}};
  table.create = {0x11, 4};
  table.block_load = {0x12, 5};
  table.pool = {0x13, 5};
  table.last_type = 11;
  table.quirks.control_bits = true;
  table.quirks.board_control = true;
  return table;
}

StickFamilyTable vjoy() {
  StickFamilyTable table{};
  table.name = "vjoy";
  table.vendor = 0x1234;
  table.product = 0xbead;
  table.usb_version = 0x0200;
  table.device_version = 0x0222;
  table.maker = "Shaul Eizikovich";
  table.product_name = "vJoy - Virtual Joystick";
  table.serial = "2.2.2";
  table.endpoint_in = 0x81;
  table.endpoint_out = 0;
  table.lever = {{0x01, 97}, {1, 4, true}, {5, 4, true}, 0.0, 32767.0, 32, 81, 0};
  table.set_effect = long_set_effect(0x11, 32767.0);
  table.condition = long_condition(0x13, 10000.0, -10000.0);
  table.constant = {{0x15, 4}, {s16(2), 10000.0, -10000.0}};
  table.operation = {0x1A, 4};
  table.block_free = {0x1B, 2};
  table.control = {0x1C, 2};
  table.gain = {0x1D, 2};
  table.other_outputs = {{0x12, 14}, {0x14, 12}, {0x16, 6}, {0x17, 16}, {0x18, 3}, {0x1E, 5}};
  table.create = {0x11, 4};
  table.block_load = {0x12, 5};
  table.pool = {0x13, 5};
  table.block_state = {0x14, 2};
  table.last_type = 12;
  table.quirks.last_block = 100;
  return table;
}

}  // namespace

std::int64_t read_number(std::span<const std::uint8_t> report, StickNumber number) noexcept {
  std::uint64_t value = 0;
  for (int i = number.bytes - 1; i >= 0; --i) value = value << 8 | report[number.at + static_cast<std::size_t>(i)];
  const std::uint64_t sign = std::uint64_t{1} << (8 * number.bytes - 1);
  const bool is_negative = number.is_signed && (value & sign) != 0;
  return static_cast<std::int64_t>(value) - (is_negative ? static_cast<std::int64_t>(2 * sign) : 0);
}

void write_number(std::span<std::uint8_t> report, StickNumber number, std::int64_t value) noexcept {
  for (int i = 0; i < number.bytes; ++i) {
    report[number.at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

double read_fraction(std::span<const std::uint8_t> report, const StickFraction& fraction) noexcept {
  const double value = static_cast<double>(read_number(report, fraction.number));
  return value < 0.0 ? -value / fraction.min : value / fraction.max;
}

const StickFamilyTable& stick_family(StickFamily family) noexcept {
  static const std::array<StickFamilyTable, 3> tables{sidewinder(), openffboard(), vjoy()};
  return tables.at(static_cast<std::size_t>(family));
}

const char* to_string(StickFamily family) noexcept {
  return stick_family(family).name;
}

std::vector<std::uint8_t> stick_report_descriptor(StickFamily family) {
  static constexpr std::array<const char*, 3> kFiles{"microsoft-sidewinder-ff2", "openffboard-2axis",
                                                     "vjoy-2axis-ffb-tlid1"};
  const std::string path =
      std::string(GEARSHIFT_TEST_DATA) + "/hid/" + kFiles.at(static_cast<std::size_t>(family)) + ".hex";
  std::ifstream file(path);
  std::vector<std::uint8_t> bytes;
  for (unsigned value = 0; file >> std::hex >> value;) bytes.push_back(static_cast<std::uint8_t>(value));
  if (bytes.empty()) throw std::runtime_error(path + ": no report descriptor there");
  return bytes;
}

}  // namespace gearshift::test
