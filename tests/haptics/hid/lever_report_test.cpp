// Tests of decoding lever positions. The report bytes were written by hand from the devices' documents.
#include "haptics/hid/lever_report.h"

#include <string>

#include <doctest/doctest.h>

#include "haptics/hid/hid_bytes.h"
#include "haptics/hid/pid_layout.h"
#include "tests/haptics/hid/descriptors.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

LeverReport lever_of(const std::vector<std::uint8_t>& bytes) {
  const auto lever = find_lever_report(parse_report_descriptor(bytes));
  REQUIRE(lever);
  return *lever;
}

bool has_lever(const std::string& text) {
  return find_lever_report(parse_report_descriptor(hex_bytes(text))).has_value();
}

std::int64_t axis(const LeverReport& lever, const LeverCounts& counts, HidUsage usage) {
  for (std::size_t i = 0; i < lever.axes.size(); ++i) {
    if (lever.axes[i].usage == usage) return counts.axis[i];
  }
  FAIL("no such axis");
  return 0;
}

LeverCounts decoded(const LeverReport& lever, const std::string& report) {
  const auto counts = decode_lever(lever, hex_bytes(report));
  REQUIRE(counts);
  return *counts;
}

constexpr HidUsage kX{1, 0x30}, kY{1, 0x31}, kRz{1, 0x35}, kSlider{1, 0x36};

}  // namespace

TEST_CASE("SideWinder FF2: ten-bit X and Y, six-bit twist, seven-bit slider, eight buttons") {
  const LeverReport lever = lever_of(device_descriptor("microsoft-sidewinder-ff2"));
  CHECK(lever.id == 1);
  CHECK(lever.size == 13);
  CHECK(lever.axes.size() == 4);
  CHECK(lever.buttons.size() == 8);
  CHECK(lever.axes[0].field.min == -512);
  CHECK(lever.axes[0].field.max == 511);
  // In the report's bits, X -512 is 200h and Y 511 is 1FFh (10 bits each), and Rz -1 is 3Fh (6 bits). The slider is at
  // 127, the hat at 8; buttons 1 and 8 are pressed.
  const LeverCounts counts = decoded(lever, "01 00 02 FF 01 3F 7F 08 81 00 00 00 00");
  CHECK(axis(lever, counts, kX) == -512);
  CHECK(axis(lever, counts, kY) == 511);
  CHECK(axis(lever, counts, kRz) == -1);
  CHECK(axis(lever, counts, kSlider) == 127);
  CHECK(counts.buttons == 0x81);
  // Padding, such as the six bits above X, is ignored.
  CHECK(axis(lever, decoded(lever, "01 01 FC 00 FC 00 00 00 00 00 00 00 00"), kX) == 1);
}

TEST_CASE("OpenFFBoard: 64 buttons, eight axes of 16 bits") {
  const LeverReport lever = lever_of(device_descriptor("openffboard-2axis"));
  CHECK(lever.size == 25);
  CHECK(lever.axes.size() == 8);
  CHECK(lever.buttons.size() == 64);
  // The report's fields are, as in HID_GamepadReport in ffb_defs.h: id, uint64 buttons, X, Y, Z, RX, RY, RZ, Dial,
  // Slider.
  const LeverCounts counts =
      decoded(lever, "01 01 00 00 00 00 00 00 80 01 80 FF 7F 00 00 00 00 00 00 FF FF 00 00 34 12");
  CHECK(axis(lever, counts, kX) == -32767);
  CHECK(axis(lever, counts, kY) == 32767);
  CHECK(axis(lever, counts, kRz) == -1);
  CHECK(axis(lever, counts, kSlider) == 0x1234);
  CHECK(counts.buttons == 0x8000000000000001U);
}

TEST_CASE("vJoy: has more axes than the maximum; X and Y are always kept") {
  const LeverReport lever = lever_of(device_descriptor("vjoy-2axis-ffb-tlid1"));
  CHECK(lever.size == 97);
  CHECK(lever.axes.size() == kMaxAxes);
  std::string report = "01 FF 7F 00 00 00 40 00 00";
  for (int i = 0; i < 18; ++i) report += " 00 00 00 00";  // 14 more axes and 4 hats
  report += " 02";
  for (int i = 0; i < 15; ++i) report += " 00";
  const LeverCounts counts = decoded(lever, report);
  CHECK(axis(lever, counts, kX) == 32767);
  CHECK(axis(lever, counts, kY) == 0x4000);
  CHECK(counts.buttons == 2);

  // X and Y follow nine other axes: seven of usage page 1 (Z to wheel) and two of the simulation page.
  const LeverReport late = lever_of(hex_bytes(
      "05 01 09 04 A1 01 15 00 26 FF 00 75 08 95 09 09 32 09 33 09 34 09 35 09 36 09 37 09 38 05 02 09 BA 09 BB "
      "81 02 05 01 09 30 09 31 95 02 81 02 C0"));
  CHECK(late.axes.size() == kMaxAxes);
  CHECK(late.axes[6].usage == kX);
  CHECK(late.axes[7].usage == kY);
  CHECK(late.axes[7].field.offset == 80);
}

TEST_CASE("pads and wheels without force feedback also have a lever report") {
  const LeverReport saitek = lever_of(device_descriptor("saitek-gamepad-ff0d"));
  CHECK(saitek.size == 7);
  CHECK(saitek.axes.size() == 4);  // the axes are X, Y, rudder and throttle
  CHECK(saitek.axes[2].usage == HidUsage{2, 0xba});
  CHECK(saitek.buttons.size() == 12);
  CHECK(decoded(saitek, "01 80 FF 00 7F 01 08").buttons == 0x801);  // the button bits begin in byte 5
  CHECK(lever_of(device_descriptor("sony-dualshock4-v2-usb")).size == 64);
  CHECK(lever_of(device_descriptor("logitech-g29-ps4")).axes.size() == 6);
  CHECK_FALSE(find_lever_report(parse_report_descriptor(device_descriptor("fanatec-clubsport-handbrake"))));
}

TEST_CASE("no lever: a mouse, a stick of one axis, axes of a keyboard, axes that are padding") {
  const std::string axes = "09 30 09 31 15 81 25 7F 75 08 95 02 ";
  CHECK(has_lever("05 01 09 04 A1 01 " + axes + "81 02 C0"));
  CHECK(has_lever("05 01 09 08 A1 01 A1 02 A1 02 " + axes + "81 02 C0 C0 C0"));  // X and Y in nested collections
  CHECK_FALSE(has_lever("05 01 09 02 A1 01 " + axes + "81 06 C0"));
  CHECK_FALSE(has_lever("05 01 09 04 A1 01 " + axes + "81 06 C0"));  // relative
  CHECK_FALSE(has_lever("05 01 09 06 A1 01 " + axes + "81 02 C0"));
  CHECK_FALSE(has_lever("05 01 09 04 A1 01 " + axes + "81 03 C0"));
  CHECK_FALSE(has_lever("05 01 09 04 A1 01 " + axes + "91 02 C0"));
  CHECK_FALSE(has_lever("05 01 09 04 A1 01 09 30 75 08 95 01 81 02 85 02 09 31 81 02 C0"));  // X and Y in two reports
  // The same axes are rejected in a report of more than 256 bytes; here 255 vendor bytes precede the axes.
  CHECK_FALSE(has_lever("05 01 09 04 A1 01 75 08 96 FF 00 81 01 " + axes + "81 02 C0"));
}

TEST_CASE("a wheel without Y is no lever, even if it pushes") {
  const ReportDescriptor wheel = parse_report_descriptor(device_descriptor("switchscience-ffb-steering-go"));
  CHECK(find_pid(wheel));
  CHECK_FALSE(find_lever_report(wheel));
}

// As in Linux, which adds zeros to short reports: some sticks send more or fewer bytes than they declare.
TEST_CASE("a report with another ID, or that ends before X and Y, is rejected") {
  const LeverReport lever = lever_of(device_descriptor("saitek-gamepad-ff0d"));
  CHECK(decode_lever(lever, hex_bytes("01 80 80 80 80 00 00")));
  CHECK_FALSE(decode_lever(lever, hex_bytes("02 80 80 80 80 00 00")));
  CHECK(decode_lever(lever, hex_bytes("01 80 80 80 80 00")));
  CHECK(decode_lever(lever, hex_bytes("01 80 80 80 80 00 00 00")));
  CHECK(decode_lever(lever, hex_bytes("01 81 82"))->axis[1] == 0x82);
  CHECK_FALSE(decode_lever(lever, hex_bytes("01 81")));
  CHECK_FALSE(decode_lever(lever, {}));
}

TEST_CASE("bits: any offset, any width, with and without sign; nothing beyond the report") {
  struct {
    BitField field;
    const char* report;
    std::int64_t value;
  } const cases[] = {
      {{0, 8, 0, 255, 0}, "00 A5 00 00 00 00", 0xa5},
      {{4, 8, 0, 255, 0}, "00 50 0A 00 00 00", 0xa5},
      {{4, 8, -128, 127, 0}, "00 50 0A 00 00 00", 0xa5 - 256},
      {{7, 1, 0, 1, 0}, "00 80 00 00 00 00", 1},
      {{6, 10, -512, 511, 0}, "00 C0 FF 00 00 00", -1},
      {{1, 32, 0, 0xffffffff, 0}, "00 FE FF FF FF 01", 0xffffffff},
      {{8, 32, -0x80000000LL, 0x7fffffff, 0}, "00 00 00 00 00 80", -0x80000000LL},
  };
  for (const auto& one : cases) {
    CAPTURE(one.report);
    const BitField& field = one.field;
    std::vector<std::uint8_t> bytes = hex_bytes(one.report);
    CHECK(read_bits(bytes, field) == one.value);
    std::vector<std::uint8_t> blank(bytes.size());
    write_bits(blank, field, one.value);
    CHECK(hex(blank) == one.report);
    // Writing a field must not change the neighbouring bits.
    std::vector<std::uint8_t> full(bytes.size(), 0xff);
    write_bits(full, field, 0);
    CHECK(read_bits(full, field) == 0);
    write_bits(full, field, -1);
    write_bits(full, field, field.min < 0 ? -1 : field.max);
    CHECK(hex(full) == "FF FF FF FF FF FF");
    // If the report is one byte too short for the field, reading returns 0 and writing changes nothing.
    const std::size_t needed = static_cast<std::size_t>(8 + field.offset + field.bits + 7) / 8;
    bytes.resize(needed - 1);
    CHECK(read_bits(bytes, field) == 0);
    const std::string before = hex(bytes);
    write_bits(bytes, field, field.max);
    CHECK(hex(bytes) == before);
  }
  std::vector<std::uint8_t> report(3);
  write_bits(report, {0, 8, -100, 100, 0}, 1000);
  write_bits(report, {8, 8, -100, 100, 0}, -1000);
  CHECK(hex(report) == "00 64 9C");
  CHECK(read_bits(report, BitField{}) == 0);
  CHECK(read_bits({}, {0, 8, 0, 255, 0}) == 0);
}

TEST_CASE("a field's range is limited to what its bits can hold; its zero is where the physical range has it") {
  const auto field = [](const std::string& items) {
    return bit_field(parse_report_descriptor(hex_bytes("75 08 95 02 " + items + " 91 02")).fields[0], 1);
  };
  const BitField usual = field("15 80 25 7F");
  CHECK(usual.offset == 8);
  CHECK(usual.min == -128);
  CHECK(usual.max == 127);
  CHECK(usual.zero == 0);
  CHECK(field("15 00 26 FF 7F").max == 255);                     // 32767 does not fit into 8 bits
  CHECK(field("16 F0 D8 26 10 27").min == -128);                 // -10000 does not fit into 8 bits
  CHECK(field("15 00 25 00").max == 255);                        // an empty range counts as 0 to 255
  CHECK(field("15 05 25 01").min == 0);                          // an inverted range counts as 0 to 255
  CHECK(field("15 00 26 FF 00 36 F0 D8 46 10 27").zero == 128);  // 127.5, the middle of 0 to 255
  CHECK(field("15 00 26 FF 00 35 00 46 10 27").zero == 0);
  CHECK(field("15 01 25 64 35 01 45 64").zero == 1);
  CHECK_FALSE(bit_field(parse_report_descriptor(hex_bytes("75 21 95 01 91 02")).fields[0], 0).exists());
  CHECK_FALSE(bit_field(parse_report_descriptor(hex_bytes("75 08 95 01 91 02")).fields[0], 1).exists());
}

TEST_CASE("two reports are equal if their used bytes are equal") {
  HidBytes a, b;
  a.bytes[5] = 1;
  CHECK(a == b);
  a.size = b.size = 6;
  CHECK_FALSE(a == b);
  b.bytes[5] = 1;
  CHECK(a == b);
  b.size = 5;
  CHECK_FALSE(a == b);
}
