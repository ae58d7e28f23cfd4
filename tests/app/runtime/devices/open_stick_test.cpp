// Tests finding the stick that the user named. The result is that stick, or an error that lists the connected sticks.
#include "app/runtime/devices/open_stick.h"

#include <doctest/doctest.h>

#include "tests/app/runtime/devices/described_sticks.h"
#include "tests/support/temp_folder.h"
#include "tests/support/turkish_letters.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;

namespace {

KnownStick calibrated(const UsbHidDevice& device) {
  KnownStick known;
  known.calibration.vendor = device.identity.vendor;
  known.calibration.product = device.identity.product;
  known.calibration.serial = device.identity.serial;
  known.calibration.name = device.identity.name;
  known.report_descriptor = device.report_descriptor;
  for (LeverAxisCalibration* axis : {&known.calibration.select, &known.calibration.shift}) {
    axis->low = -512;
    axis->high = 511;
    axis->travel = 0.14;
    axis->constant_sign = 1;
    axis->full_force = 15.0;
  }
  known.calibration.shift.usage = 0x31;
  known.calibration.timing = {0.001, 0.001, 0.003, 0.0005};
  return known;
}

std::string refusal(const std::string& wanted, const std::vector<UsbHidDevice>& plugged,
                    const std::filesystem::path& folder = {}) {
  try {
    (void)resolve_stick(wanted, list_sticks(plugged, folder), folder);
    return "taken";
  } catch (const std::runtime_error& refused) {
    return refused.what();
  }
}

bool says(const std::string& sentence, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    if (sentence.find(part) == std::string::npos) return false;
  return sentence.find('\n') == std::string::npos;
}

}  // namespace

TEST_CASE("part of the name, VENDOR:PRODUCT (both in any case), serial number and place each select the stick") {
  const std::vector<UsbHidDevice> plugged{sidewinder(), openffboard()};
  const std::vector<ListedStick> sticks = list_sticks(plugged, {});
  for (const char* wanted : {"sidewinder", "FORCE", "045e:001b", "045E:001B", "1-1"})
    CHECK(select_stick(wanted, sticks).identity.vendor == 0x045e);
  for (const char* wanted : {"ffb", "2A0030", "1209:FFB0", "1-2"})
    CHECK(select_stick(wanted, sticks).identity.vendor == 0x1209);
}

TEST_CASE("the stick is also found in a Turkish locale, where i is not the lower case of I") {
  const TurkishLetters turkish;
  const std::vector<UsbHidDevice> plugged{sidewinder()};
  CHECK(select_stick("SIDEWINDER", list_sticks(plugged, {})).identity.vendor == 0x045e);
}

TEST_CASE("a complete serial number or place takes precedence over part of a name") {
  UsbHidDevice other = sidewinder("1-3");
  other.identity.name = "Copy of 2A0030";
  const std::vector<UsbHidDevice> plugged{other, openffboard()};
  CHECK(select_stick("2A0030", list_sticks(plugged, {})).identity.vendor == 0x1209);
}

TEST_CASE("of several interfaces of one device, the first with forces is meant") {
  UsbHidDevice keys = usb_device("sony-dualshock4-v2-usb", 0x1209, 0xffb0, "FFBoard", "1-2", "2A0030");
  UsbHidDevice base = openffboard(), second = openffboard();
  keys.interface = 0;
  base.interface = 1;
  second.interface = 2;
  const TempFolder folder;
  save_known_stick(calibrated(base), folder.path());
  const std::vector<UsbHidDevice> plugged{keys, second, base};
  const ResolvedStick stick = resolve_stick("ffboard", list_sticks(plugged, folder.path()), folder.path());
  CHECK(stick.interface == 1);
  CHECK(stick.identity.place.empty());  // no twin, so any port will do
  // Two such devices are still two sticks.
  UsbHidDevice twin = base;
  twin.identity.place = "1-7";
  CHECK(says(refusal("ffboard", {keys, base, twin}, folder.path()), {"several", "at 1-2", "at 1-7"}));
}

TEST_CASE("several matches, no match or no stick at all: one printable sentence with the connected sticks") {
  const std::vector<UsbHidDevice> twins{sidewinder("1-1"), sidewinder("1-2"), openffboard("1-3")};
  CHECK(says(refusal("sidewinder", twins), {"several", "at 1-1", "at 1-2"}));
  CHECK_FALSE(says(refusal("sidewinder", twins), {"FFBoard"}));
  CHECK(says(refusal("rhino", twins),
             {"no stick that matches \"rhino\" is plugged in", "FFBoard (1209:ffb0, serial 2A0030, at 1-3)"}));
  CHECK(says(refusal("rhino", {}), {"no stick that matches \"rhino\" is plugged in"}));
  CHECK(says(refusal("", twins), {"no stick that matches \"\""}));
  CHECK_FALSE(says(refusal("a\x1b[2Jb", {}), {"\x1b"}));
}

TEST_CASE(
    "of two sticks that differ only by place, the named one is opened; a single stick may be plugged in anywhere") {
  const TempFolder folder;
  save_known_stick(calibrated(sidewinder()), folder.path());
  const std::vector<UsbHidDevice> twins{sidewinder("1-1"), sidewinder("1-2")};
  CHECK(resolve_stick("1-2", list_sticks(twins, folder.path()), folder.path()).identity.place == "1-2");
  const std::vector<UsbHidDevice> single{sidewinder("1-2")};
  CHECK(resolve_stick("sidewinder", list_sticks(single, folder.path()), folder.path()).identity.place.empty());
  CHECK(resolve_stick("1-2", list_sticks(single, folder.path()), folder.path()).identity.place == "1-2");
}

TEST_CASE("a stick without access rights, force feedback or calibration is rejected with the remedy") {
  const TempFolder folder;
  UsbHidDevice forbidden = sidewinder();
  forbidden.problem = "the reason";
  CHECK(refusal("sidewinder", {forbidden}, folder.path()) == "the reason");
  const UsbHidDevice pad = usb_device("sony-dualshock4-v2-usb", 0x054c, 0x09cc, "Pad", "1-3");
  CHECK(says(refusal("pad", {pad}, folder.path()), {"cannot be used with --device (no force feedback)"}));
  CHECK(says(refusal("ffb", {openffboard()}, folder.path()),
             {"range, travel and force, delay, force direction missing", "gearshift devices --calibrate 1209:ffb0"}));
}

TEST_CASE("a calibrated stick that is not plugged in is waited for if its name is unambiguous") {
  const TempFolder folder;
  save_known_stick(calibrated(openffboard()), folder.path());
  const ResolvedStick absent = resolve_stick("ffboard", {}, folder.path());
  CHECK(absent.identity.serial == "2A0030");
  CHECK(absent.known.report_descriptor == openffboard().report_descriptor);
  CHECK(says(refusal("sidewinder", {}, folder.path()), {"no stick that matches \"sidewinder\""}));
  UsbHidDevice second = openffboard();
  second.identity.serial = "2A0031";
  save_known_stick(calibrated(second), folder.path());
  CHECK(says(refusal("ffboard", {}, folder.path()), {"several", "2A0030", "2A0031"}));
  CHECK(resolve_stick("2A0031", {}, folder.path()).identity.serial == "2A0031");
}
