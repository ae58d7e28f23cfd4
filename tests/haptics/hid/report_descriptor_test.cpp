// Tests of parsing report descriptors. The expected values were read from the bytes by hand, following HID 1.11
// sections 5 and 6.2.2. Linux' hid-core finds the same 293 fields in the devices' descriptors (haptics/hid/README.md).
#include "haptics/hid/report_descriptor.h"

#include <string>

#include <doctest/doctest.h>

#include "haptics/hid/hid_error.h"
#include "tests/haptics/hid/descriptors.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

ReportDescriptor parsed(const std::string& text) {
  return parse_report_descriptor(hex_bytes(text));
}

// Returns the only field that `items` declare. The field has 8 bits unless the items give a size.
HidField field_of(const std::string& items) {
  const ReportDescriptor descriptor = parsed("75 08 95 01 " + items);
  REQUIRE(descriptor.fields.size() == 1);
  return descriptor.fields[0];
}

std::string refusal(const std::string& text) {
  try {
    parsed(text);
  } catch (const HidError& error) {
    return error.what();
  }
  return "none";
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

}  // namespace

TEST_CASE("a maximum is signed if the minimum is: 25 FF above 0 is 255, 26 FF FF is 65535") {
  struct {
    const char* items;
    std::int64_t min, max;
  } const ranges[] = {
      {"15 00 25 FF", 0, 255},
      {"25 FF 15 00", 0, 255},  // maximum before minimum
      {"15 00 26 FF FF", 0, 65535},
      {"15 00 27 FF FF 00 00", 0, 65535},
      {"15 00 27 FF FF FF FF", 0, 4294967295},
      {"15 81 25 7F", -127, 127},
      {"16 00 80 26 FF 7F", -32768, 32767},
      {"16 F0 D8 26 10 27", -10000, 10000},
      {"15 80 25 FF", -128, -1},
      {"14 24", 0, 0},  // an item without data has the value 0
      {"15 01 26 FF 00", 1, 255},
  };
  for (const auto& range : ranges) {
    CAPTURE(range.items);
    const HidField field = field_of(std::string(range.items) + " 81 02");
    CHECK(field.logical_min == range.min);
    CHECK(field.logical_max == range.max);
    CHECK(field.is_signed() == (range.min < 0));
  }
  const HidField physical = field_of("15 00 25 FF 36 F0 D8 46 10 27 81 02");
  CHECK(physical.physical_min == -10000);
  CHECK(physical.physical_max == 10000);
}

TEST_CASE("the unit's exponent is a signed nibble") {
  CHECK(field_of("55 FD 81 02").unit_exponent == -3);
  CHECK(field_of("55 0D 81 02").unit_exponent == -3);
  CHECK(field_of("55 07 81 02").unit_exponent == 7);
  CHECK(field_of("55 08 81 02").unit_exponent == -8);
  CHECK(field_of("66 03 10 55 FD 81 02").unit == 0x1003);
}

TEST_CASE("usages: of 32 bits, in ranges, fewer or more than elements, of several pages") {
  using Usages = std::vector<HidUsage>;
  // 32-bit usages include their page. The current usage page does not matter, whether it is set before or after the
  // usage.
  CHECK(field_of("05 0F 0B 01 00 0A 00 0B 02 00 0A 00 95 02 91 02").usages == Usages{{0x0a, 1}, {0x0a, 2}});
  CHECK(field_of("0B 30 00 01 00 05 09 81 02").usages == Usages{{1, 0x30}});
  // Usage ranges: minimum first, maximum first, and 32-bit usages.
  CHECK(field_of("05 09 19 02 29 04 95 03 81 02").usages == Usages{{9, 2}, {9, 3}, {9, 4}});
  CHECK(field_of("05 09 29 04 19 02 95 03 81 02").usages == Usages{{9, 2}, {9, 3}, {9, 4}});
  CHECK(field_of("1B 01 00 09 00 2B 02 00 09 00 95 02 81 02").usages == Usages{{9, 1}, {9, 2}});
  CHECK(field_of("05 09 19 04 29 02 81 02").usages.empty());  // inverted range: none
  // The last usage applies to all remaining elements of the field.
  const HidField buttons = field_of("05 09 19 01 29 02 75 01 95 04 81 02");
  CHECK(buttons.usage(0) == HidUsage{9, 1});
  CHECK(buttons.usage(1) == HidUsage{9, 2});
  CHECK(buttons.usage(3) == HidUsage{9, 2});
  // If there are more usages than elements, all are stored, because the elements may select one of them.
  CHECK(field_of("05 0F 09 97 09 98 95 01 91 02").usages.size() == 2);
  CHECK(field_of("81 01").usage(0) == HidUsage{});
  // Each usage has the page that is current when the usage is declared. A single page after all usages applies to all.
  CHECK(field_of("05 01 09 30 05 02 09 BA 95 02 81 02").usages == Usages{{1, 0x30}, {2, 0xba}});
  CHECK(field_of("05 09 09 30 09 31 05 01 95 02 81 02").usages == Usages{{1, 0x30}, {1, 0x31}});
  // Only the first of several alternative usages between delimiters counts.
  CHECK(field_of("05 01 A9 01 09 30 09 36 A9 00 09 31 95 02 81 02").usages == Usages{{1, 0x30}, {1, 0x31}});
  // Usages belong to the next main item only.
  CHECK(parsed("75 08 95 01 05 01 09 30 81 02 81 02").fields[1].usages.empty());
}

TEST_CASE("global items persist, pushed ones are restored") {
  // The second field inherits the count of the first, but has its own size and maximum. The third field has the pushed
  // values, which are those of the first field.
  const ReportDescriptor descriptor = parsed("75 04 95 02 15 00 25 0F 81 02 A4 25 07 75 03 81 02 B4 81 02");
  REQUIRE(descriptor.fields.size() == 3);
  CHECK(descriptor.fields[1].bits == 3);
  CHECK(descriptor.fields[1].count == 2);
  CHECK(descriptor.fields[1].logical_max == 7);
  CHECK(descriptor.fields[1].offset == 8);
  CHECK(descriptor.fields[2].bits == 4);
  CHECK(descriptor.fields[2].logical_max == 15);
  CHECK(descriptor.fields[2].offset == 14);
  CHECK(descriptor.report_size(ReportKind::input, 0) == 1 + 3);  // 22 bits
}

TEST_CASE("one report ID for inputs, outputs and features, each with its own size") {
  const ReportDescriptor descriptor = parsed("85 01 75 08 95 03 81 02 95 01 91 02 85 02 95 07 B1 02 85 01 75 02 81 02");
  CHECK(descriptor.numbered);
  CHECK(descriptor.report_size(ReportKind::input, 1) == 1 + 5);  // after the ID: 24 + 7 x 2 = 38 bits, so 5 bytes
  CHECK(descriptor.report_size(ReportKind::output, 1) == 1 + 1);
  CHECK(descriptor.report_size(ReportKind::feature, 1) == 0);
  CHECK(descriptor.report_size(ReportKind::feature, 2) == 1 + 7);
  CHECK(descriptor.fields.back().offset == 24);
}

TEST_CASE("reports without an ID, only such reports and mixed with numbered ones") {
  const ReportDescriptor handbrake = parse_report_descriptor(device_descriptor("fanatec-clubsport-handbrake"));
  CHECK_FALSE(handbrake.numbered);
  CHECK(handbrake.report_size(ReportKind::input, 0) == 1 + 4);  // ID byte (always 0) + 1 axis byte and 3 vendor bytes
  CHECK(handbrake.report_size(ReportKind::output, 0) == 1 + 2);
  const ReportDescriptor mixed = parsed("75 08 95 02 81 02 85 03 81 02");
  CHECK(mixed.numbered);
  CHECK(mixed.report_size(ReportKind::input, 0) == 1 + 2);
  CHECK(mixed.report_size(ReportKind::input, 3) == 1 + 2);
}

TEST_CASE("flags of a main item: padding, arrays, relative values, in one byte, two or none") {
  const HidField buffered = field_of("92 02 01");  // SideWinder's flags: data, variable, absolute, buffered bytes
  CHECK(buffered.kind == ReportKind::output);
  CHECK_FALSE(buffered.constant);
  CHECK_FALSE(buffered.array);
  CHECK(field_of("81 01").constant);
  CHECK(field_of("81 03").constant);
  CHECK(field_of("81 00").array);
  CHECK(field_of("80").array);
  CHECK(field_of("81 06").relative);
  CHECK(field_of("B1 02").kind == ReportKind::feature);
}

TEST_CASE("fields wider than 32 bits occupy space in the report, empty fields do not") {
  const ReportDescriptor wide = parsed("75 40 95 01 91 02 75 78 91 01 75 00 91 02 75 08 95 00 91 02 95 01 91 02");
  REQUIRE(wide.fields.size() == 3);
  CHECK(wide.fields[0].bits == 64);
  CHECK(wide.fields[2].offset == 64 + 120);
}

TEST_CASE("collections: nested, without usages, and the fields inside them") {
  const ReportDescriptor descriptor =
      parsed("05 01 09 04 A1 01 A1 00 09 30 75 08 95 01 81 02 C0 05 0F 09 21 A1 02 09 22 91 02 C0 C0 09 01 B1 02");
  REQUIRE(descriptor.collections.size() == 3);
  CHECK(descriptor.collections[0].usage == HidUsage{1, 4});
  CHECK(descriptor.collections[0].type == 1);
  CHECK(descriptor.collections[1].usage == HidUsage{});
  CHECK(descriptor.collections[1].parent == 0);
  CHECK(descriptor.collections[2].parent == 0);
  REQUIRE(descriptor.fields.size() == 3);
  CHECK(descriptor.is_within(descriptor.fields[0], {1, 4}));
  CHECK_FALSE(descriptor.is_within(descriptor.fields[0], {0x0f, 0x21}));
  CHECK(descriptor.is_within(descriptor.fields[1], {0x0f, 0x21}));
  CHECK(descriptor.is_within(descriptor.fields[1], {1, 4}));
  CHECK(descriptor.fields[2].collection == -1);
  CHECK_FALSE(descriptor.is_within(descriptor.fields[2], {1, 4}));

  const std::string deep = repeated("A1 02 ", 300) + "75 08 95 01 81 02 " + repeated("C0 ", 300);
  CHECK(parsed(deep).collections.size() == 300);
}

TEST_CASE("trailing zeros, long items and unknown items are skipped") {
  CHECK(parsed("A1 01 75 08 95 01 81 02 C0 00").fields.size() == 1);
  CHECK(parsed("A1 01 75 08 95 01 81 02 C0 " + repeated("00 ", 3000)).fields.size() == 1);
  CHECK(parsed("75 08 95 01 FE 03 F0 81 02 C0 81 02").fields.size() == 1);  // skips a long item: 3 bytes, tag 0xF0
  CHECK(parsed("75 08 95 01 0D 12 72 F5 01 81 02").fields.size() == 1);     // skips a reserved and an unknown item
  CHECK(parsed("75 08 95 01 79 01 39 02 81 02").fields.size() == 1);        // skips string and designator items
  CHECK(parsed("").fields.empty());
  CHECK(parsed("00 00 00").fields.empty());
}

TEST_CASE("an invalid descriptor is refused with one sentence and the byte offset") {
  CHECK(refusal("05") == "the report descriptor is invalid at byte 0 (the last item is cut off)");
  CHECK(refusal("75 08 95 01 81 02 26 FF") == "the report descriptor is invalid at byte 6 (the last item is cut off)");
  CHECK(refusal("05 01 FE 09 F0 01") == "the report descriptor is invalid at byte 2 (a long item is cut off)");
  CHECK(refusal("05 01 FE") == "the report descriptor is invalid at byte 2 (a long item is cut off)");
  CHECK(refusal("05 01 A1 01 A1 00 C0") ==
        "the report descriptor is invalid at byte 2 (the collection that begins here never ends)");
  CHECK(refusal("A1 01 C0 C0") ==
        "the report descriptor is invalid at byte 3 (an End Collection item has no matching Collection item)");
  CHECK(refusal("75 08 B4") == "the report descriptor is invalid at byte 2 (a Pop item has no matching Push item)");
  CHECK(refusal("86 2C 01") == "the report descriptor is invalid at byte 0 (report ID 300 is above 255)");
  CHECK(refusal("75 08 96 FF FF 81 02") == "none");
  CHECK(refusal("75 08 96 FF FF 81 02 95 01 81 02") ==
        "the report descriptor is invalid at byte 9 (the report is longer than 65535 bytes)");
  CHECK(refusal("77 FF FF FF FF 97 FF FF FF FF 81 02") ==
        "the report descriptor is invalid at byte 10 (the report is longer than 65535 bytes)");
  CHECK(refusal("75 01 95 01 " + repeated("81 02 ", 4096)) == "none");
  CHECK(refusal("75 01 95 01 " + repeated("81 02 ", 4097)) ==
        "the report descriptor is invalid at byte 8196 (more than 4096 fields)");
  CHECK(refusal(repeated("A1 02 C0 ", 4097)) ==
        "the report descriptor is invalid at byte 12288 (more than 4096 collections)");
}

TEST_CASE("descriptors of real devices that are broken: one sentence each") {
  // The type byte after the first 0xA1 (Collection) is missing. So the next byte, 0x09, is parsed as the type, and the
  // second 0xA1 as the data of an item 0x01. Therefore one End Collection is left over.
  CHECK(refusal(hex(device_descriptor("odd-saitek-x52-missing-byte"))) ==
        "the report descriptor is invalid at byte 117 (an End Collection item has no matching Collection item)");
  // The descriptor ends too early: after its byte 223, only zeros follow up to 4096 bytes. Its second collection begins
  // at byte 164.
  CHECK(refusal(hex(device_descriptor("odd-zeroplus-xbox-wireless"))) ==
        "the report descriptor is invalid at byte 164 (the collection that begins here never ends)");
  // Every valid descriptor of a PID device must be refused if its last byte is missing.
  for (const char* device : kPidDevices) {
    CAPTURE(device);
    std::vector<std::uint8_t> bytes = device_descriptor(device);
    bytes.pop_back();
    CHECK(refusal(hex(bytes)).ends_with("(the collection that begins here never ends)"));
  }
}

TEST_CASE("the devices' reports are as long as documented") {
  const ReportDescriptor sidewinder = parse_report_descriptor(device_descriptor("microsoft-sidewinder-ff2"));
  CHECK(sidewinder.report_size(ReportKind::input, 1) == 13);
  CHECK(sidewinder.report_size(ReportKind::output, 1) == 16);  // wMaxPacketSize of the OUT endpoint is 16
  const ReportDescriptor board = parse_report_descriptor(device_descriptor("openffboard-2axis"));
  CHECK(board.report_size(ReportKind::input, 1) == 1 + 8 + 8 * 2);  // ffb_defs.h: 64 buttons, 8 axes of 16 bits
  CHECK(board.report_size(ReportKind::output, 3) == 15);            // FFB_SetCondition_Data_t
  CHECK(board.report_size(ReportKind::input, 0xa1) == 1 + 24);      // HID command fields: 8 16 8 32 64 64 bits
  const ReportDescriptor vjoy = parse_report_descriptor(device_descriptor("vjoy-2axis-ffb-tlid1"));
  CHECK(vjoy.report_size(ReportKind::input, 1) == 1 + 20 * 4 + 1 + 15);  // 16 axes, 4 unused hats, 8 buttons, padding
  const ReportDescriptor pad = parse_report_descriptor(device_descriptor("sony-dualshock4-v2-usb"));
  CHECK(pad.report_size(ReportKind::input, 1) == 64);
  CHECK(pad.report_size(ReportKind::output, 5) == 32);
  CHECK(pad.report_size(ReportKind::feature, 2) == 37);
}
