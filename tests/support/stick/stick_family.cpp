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

constexpr StickFraction gain_byte(std::size_t at) {
  return {u8(at), 255.0};
}

// Byte offsets: 1 block, 2 type, 3 duration, 5 trigger repeat, 7 sample period, 9 gain, 10 trigger button, 11 axes, 12
// and 13 directions (one byte each), 14 start delay.
SetEffectBytes short_set_effect() {
  SetEffectBytes bytes{{0x01, 16}, u16(3), u16(14), gain_byte(9), 10, 11};
  bytes.direction_x = u8(12);
  bytes.direction_y = u8(13);
  bytes.full_turn = 256.0;
  return bytes;
}

// In this longer report the start delay comes before the gain, directions have two bytes, and two type-specific offsets
// are at the end.
SetEffectBytes long_set_effect(std::uint8_t id, double full_turn) {
  SetEffectBytes bytes{{id, 22}, u16(3), u16(9), gain_byte(11), 12, 13};
  bytes.direction_x = u16(14);
  bytes.direction_y = u16(16);
  bytes.full_turn = full_turn;
  return bytes;
}

ConditionBytes short_condition() {
  const auto s8 = [](std::size_t at) { return StickFraction{{at, 1, true}, 127.0, -128.0}; };
  const auto fraction = [](std::size_t at) { return StickFraction{u8(at), 255.0}; };
  return {{0x03, 9}, s8(3), s8(4), s8(5), fraction(6), fraction(7), fraction(8), {}};
}

ConditionBytes long_condition(std::uint8_t id, double max, double min) {
  const auto signed_fraction = [&](std::size_t at) { return StickFraction{s16(at), max, min}; };
  const auto fraction = [&](std::size_t at) { return StickFraction{u16(at), max}; };
  return {{id, 15},    signed_fraction(3), signed_fraction(5), signed_fraction(7),
          fraction(9), fraction(11),       fraction(13),       {}};
}

StickFamilyTable sidewinder() {
  StickFamilyTable table{};
  table.name = "sidewinder";
  table.descriptor = "microsoft-sidewinder-ff2";
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
  table.state = {{0x02, 3}};
  table.set_effect = short_set_effect();
  table.condition = short_condition();
  table.constant = {{0x05, 4}, {s16(2), 255.0, -255.0}, {}};
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
  table.descriptor = "openffboard-2axis";
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
  table.state = {{0x02, 2}};
  table.state.power = 3;
  table.state.playing = 4;
  table.set_effect = long_set_effect(0x01, 36000.0);
  table.condition = long_condition(0x03, 32767.0, -32768.0);
  table.constant = {{0x05, 4}, {s16(2), 32767.0, -32767.0}, {}};
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
  table.descriptor = "vjoy-2axis-ffb-tlid1";
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
  table.constant = {{0x15, 4}, {s16(2), 10000.0, -10000.0}, {}};
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

StickFamilyTable openffboard_32bit() {
  StickFamilyTable table = openffboard();
  table.name = "openffboard 32-bit";
  table.descriptor = "openffboard-2axis-32bit-1.17";
  table.lever = {{0x01, 29}, {9, 4, true}, {13, 4, true}, -2147483647.0, 2147483647.0, 32, 1, 0};
  return table;
}

// The report IDs that the Arduino library and its relatives share. Byte offsets of Set Effect: 9 gain, 10 trigger
// button, 11 axes, 12 and 13 directions, 14 and 16 type-specific offsets; no start delay.
StickFamilyTable arduino_like(const char* name, const char* descriptor, double full, int blocks) {
  StickFamilyTable table{};
  table.name = name;
  table.descriptor = descriptor;
  table.vendor = 0x2341;
  table.product = 0x8036;
  table.usb_version = 0x0200;
  table.device_version = 0x0100;
  table.maker = "Arduino LLC";
  table.product_name = "Arduino Leonardo";
  table.serial = "HIDEM";
  table.endpoint_in = 0x84;
  table.endpoint_out = 0x04;
  table.lever = {{0x01, 6}, s16(2), s16(4), -32767.0, 32767.0, 16, 1, 0};
  table.state = {{0x02, 3}};
  table.set_effect = SetEffectBytes{{0x01, 18}, u16(3), {}, gain_byte(9), 10, 11};
  table.set_effect.direction_x = u8(12);
  table.set_effect.direction_y = u8(13);
  table.set_effect.full_turn = 255.0;
  table.condition = long_condition(0x03, full, -full);
  table.constant = {{0x05, 4}, {s16(2), full, -full}, {}};
  table.operation = {0x0A, 4};
  table.block_free = {0x0B, 2};
  table.control = {0x0C, 2};
  table.gain = {0x0D, 2};
  table.create = {0x05, 4};
  table.block_load = {0x06, 5};
  table.pool = {0x07, 5};
  table.last_type = 12;
  table.quirks.last_block = blocks;
  table.quirks.more_announced = 1;
  return table;
}

StickFamilyTable arduino() {
  StickFamilyTable table = arduino_like("arduino", "arduino-ffb-library-yukminglaw-xy", 10000.0, 13);
  table.other_outputs = {{0x02, 14}, {0x04, 12}, {0x06, 6}, {0x07, 16}, {0x08, 2}, {0x0E, 5}};
  return table;
}

StickFamilyTable arduino_hat() {
  StickFamilyTable table = arduino();
  table.name = "arduino hat";
  table.descriptor = "arduino-ffb-library-yukminglaw-xy-hat";
  table.lever = {{0x01, 7}, s16(3), s16(5), -32767.0, 32767.0, 16, 1, 2};
  return table;
}

StickFamilyTable adapt_ffb_joy() {
  StickFamilyTable table = arduino_like("adapt-ffb-joy", "adapt-ffb-joy-tloimu", 10000.0, 18);
  table.vendor = 0x03eb;
  table.product = 0x204e;
  table.maker = "LUFA";
  table.product_name = "LUFA Joystick wFFB";
  table.serial = "";
  table.endpoint_in = 0x81;
  table.endpoint_out = 0x02;
  table.lever = {{0x01, 15}, s16(1), s16(3), -512.0, 511.0, 16, 12, 14};
  table.set_effect.size = 14;
  table.set_effect.full_turn = 180.0;
  const auto s8 = [](std::size_t at) { return StickFraction{{at, 1, true}, 127.0, -128.0}; };
  table.condition = {{0x03, 5}, s8(3), s8(4), {}, {}, {}, {}, {}};
  table.constant = {{0x05, 4}, {s16(2), 255.0, -255.0}, {}};
  table.other_outputs = {{0x02, 8}, {0x04, 7}, {0x06, 4}, {0x07, 16}, {0x08, 3}, {0x0E, 5}};
  table.quirks.first_block = 2;
  table.quirks.more_announced = 0;
  return table;
}

StickFamilyTable sunffb() {
  StickFamilyTable table = arduino_like("sunffb", "sunffb-joystick", 10000.0, 15);
  table.vendor = 0xffff;
  table.product = 0x2010;
  table.maker = "SunFFB";
  table.product_name = "SunFFB Joystick";
  table.endpoint_in = 0x81;
  table.endpoint_out = 0;
  table.set_effect = SetEffectBytes{{0x03, 18}, u16(3), u16(16), gain_byte(9), 10, 11};
  table.set_effect.direction_x = u16(12);
  table.set_effect.direction_y = u16(14);
  table.set_effect.full_turn = 36000.0;
  table.condition.id = 0x05;
  table.condition.centre = {s16(3), 32767.0, -32767.0};
  table.condition.dead_band = {u16(13), 32767.0};
  table.constant.id = 0x07;
  table.operation = {0x0B, 4};
  table.block_free = {0x0C, 2};
  table.control = {0x0D, 2};
  table.gain = {0x0E, 2};
  table.other_outputs = {{0x04, 10}, {0x06, 10}, {0x08, 6}};
  table.create = {0x10, 2};
  table.block_load = {0x11, 5};
  table.pool = {0x12, 5};
  table.last_type = 11;
  table.quirks.more_announced = 0;
  return table;
}

StickFamilyTable affbwheel() {
  StickFamilyTable table = arduino_like("affbwheel", "affbwheel-vsulako", 16384.0, 13);
  table.product_name = "Arduino Micro";
  table.product = 0x8037;
  table.lever = {{0x01, 21}, s16(1), s16(3), -32768.0, 32767.0, 16, 17, 0};
  table.other_outputs = {{0x02, 10}, {0x04, 12}, {0x06, 6}, {0x0F, 8}};
  table.last_type = 11;
  return table;
}

// One direction field; a condition has one coefficient and one saturation.
StickFamilyTable brwheel() {
  StickFamilyTable table = arduino_like("brwheel", "brwheel-ranenbg", 32767.0, 10);
  table.product_name = "BRWheel";
  table.serial = "";
  table.lever = {{0x04, 13}, u16(1), u16(3), 0.0, 65535.0, 16, 10, 0};
  table.set_effect = SetEffectBytes{{0x01, 15}, u16(3), u16(13), {s16(7), 32767.0}, 9, 10};
  table.set_effect.direction_x = u16(11);
  table.set_effect.full_turn = 32768.0;
  table.condition = {
      {0x03, 10}, {s16(3), 32767.0, -32768.0}, {s16(5), 32767.0, -32768.0}, {}, {u16(7), 32767.0}, {}, {u8(9), 255.0},
      {}};
  table.other_outputs = {{0x02, 8}, {0x04, 9}, {0x06, 4}, {0xF1, 64}};
  table.last_type = 11;
  return table;
}

StickFamilyTable stm32() {
  StickFamilyTable table = arduino_like("stm32", "stm32-ffbjoystick-billydragon", 10000.0, 39);
  table.vendor = 0x2906;
  table.product = 0x1969;
  table.maker = "STMicroelectronics";
  table.product_name = "FFB Joystick";
  table.state = {{0x02, 3}};
  table.state.power = 3;
  table.state.playing = 4;
  table.set_effect = SetEffectBytes{{0x01, 17}, u16(3), {}, {u16(9), 10000.0}, 11, 12};
  table.set_effect.direction_x = u16(13);
  table.set_effect.direction_y = u16(15);
  table.set_effect.full_turn = 36000.0;
  table.gain = {0x0D, 3};
  table.gain_max = 10000.0;
  table.other_outputs = {{0x09, 10}, {0x04, 12}, {0x06, 6}, {0x07, 16}, {0x08, 3}, {0x0E, 5}};
  return table;
}

// The driver manages the pool: no create, block load or block free.
StickFamilyTable saitek() {
  StickFamilyTable table{};
  table.name = "saitek";
  table.descriptor = "saitek-cyborg-evo-force";
  table.vendor = 0x06a3;
  table.product = 0xffb5;
  table.usb_version = 0x0110;
  table.device_version = 0x0100;
  table.maker = "Saitek";
  table.product_name = "Cyborg Evo Force";
  table.serial = "";
  table.endpoint_in = 0x81;
  table.endpoint_out = 0x02;
  table.lever = {{0x06, 9}, u16(1), u16(3), 0.0, 4096.0, 16, 6, 0};
  table.state = {{0x02, 4}};
  table.state.power = 0;
  table.state.safety_switch = 1;
  table.state.actuators = 2;
  table.state.paused = 3;
  table.state.playing_is_top = true;
  table.set_effect = SetEffectBytes{{0x0B, 15}, u16(4), u16(13), {}, 3, 3, 0x40, 0x80, 0x20};
  table.set_effect.direction_x = u8(6);
  table.set_effect.full_turn = 255.0;
  table.set_effect.places = {u16(9), u16(11)};
  const auto percent = [](std::size_t at) { return StickFraction{u8(at), 100.0}; };
  const auto signed_percent = [](std::size_t at) { return StickFraction{{at, 1, true}, 100.0, -100.0}; };
  table.condition = {{0x0F, 11},        {s16(5), 500.0, -500.0},
                     signed_percent(3), signed_percent(4),
                     percent(9),        percent(10),
                     {u16(7), 1000.0},  u16(1)};
  table.constant = {{0x0D, 4}, {{3, 1, true}, 127.0, -127.0}, u16(1)};
  table.operation = {0x51, 4};
  table.control = {0x52, 2};
  table.gain = {0x43, 2};
  table.gain_max = 128.0;
  table.other_outputs = {{0x0C, 9}, {0x0E, 8}, {0x40, 4}, {0x44, 7}, {0x81, 3}};
  table.pool = {0x0B, 9};
  table.last_type = 8;
  table.types = {1, 7, 8};
  table.operations = {2, 3, 1};
  table.controls = {3, 4, 2, 1, 5, 6};
  table.quirks.first_block = 0;
  table.quirks.last_block = 9;
  table.quirks.driver_managed = true;
  return table;
}

}  // namespace

std::int64_t read_number(std::span<const std::uint8_t> report, StickNumber number) noexcept {
  if (number.bytes == 0) return 0;
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
  static const std::array<StickFamilyTable, 12> tables{
      sidewinder(),    openffboard(), vjoy(),      openffboard_32bit(), arduino(), arduino_hat(),
      adapt_ffb_joy(), sunffb(),      affbwheel(), brwheel(),           stm32(),   saitek()};
  return tables.at(static_cast<std::size_t>(family));
}

const char* to_string(StickFamily family) noexcept {
  return stick_family(family).name;
}

std::vector<std::uint8_t> stick_report_descriptor(StickFamily family) {
  const std::string path = std::string(GEARSHIFT_TEST_DATA) + "/hid/" + stick_family(family).descriptor + ".hex";
  std::ifstream file(path);
  std::vector<std::uint8_t> bytes;
  for (unsigned value = 0; file >> std::hex >> value;) bytes.push_back(static_cast<std::uint8_t>(value));
  if (bytes.empty()) throw std::runtime_error(path + ": no report descriptor there");
  return bytes;
}

}  // namespace gearshift::test
