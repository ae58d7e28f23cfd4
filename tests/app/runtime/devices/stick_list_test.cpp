// The list of connected devices, read from the descriptors of real devices (tests/data/hid).
#include "app/runtime/devices/stick_list.h"

#include <fstream>
#include <regex>

#include <doctest/doctest.h>

#include "app/runtime/devices/known_stick.h"
#include "app/runtime/devices/open_stick.h"
#include "tests/app/runtime/devices/described_sticks.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;

namespace {

// A keyboard's report descriptor: usage page 0x01, usage 0x06, one array of six keys.
const std::vector<std::uint8_t> kKeyboard{0x05, 0x01, 0x09, 0x06, 0xA1, 0x01, 0x05, 0x07, 0x19, 0x00, 0x29, 0x65,
                                          0x15, 0x00, 0x25, 0x65, 0x75, 0x08, 0x95, 0x06, 0x81, 0x00, 0xC0};

}  // namespace

TEST_CASE(
    "sticks with force feedback, pads and wheels are listed; a handbrake without X and Y and a keyboard are not") {
  const TempFolder folder;
  UsbHidDevice keyboard = usb_device("", 0x046d, 0xc31c, "Keyboard", "1-5");
  keyboard.report_descriptor = kKeyboard;
  const std::vector<UsbHidDevice> plugged{
      sidewinder(), openffboard(), usb_device("sony-dualshock4-v2-usb", 0x054c, 0x09cc, "Pad", "1-3"),
      usb_device("fanatec-clubsport-handbrake", 0x0eb7, 0x1a93, "Brake", "1-4"), keyboard};
  const std::vector<ListedStick> sticks = list_sticks(plugged, folder.path());
  REQUIRE(sticks.size() == 3);
  CHECK(describe_forces(sticks[0]) ==
        "constant force, spring, damper, 8 others");  // its Create report lists all eleven effects
  CHECK(sticks[0].buttons == 8);
  CHECK(describe_calibration(sticks[0]) == "no");
  CHECK(sticks[1].force == StickForce::force_feedback);
  CHECK(sticks[1].missing ==
        "range, travel and force, delay, force direction");  // the missing items of a stick that was never calibrated
  CHECK(describe_forces(sticks[2]) == "no force feedback");
  CHECK(sticks[2].buttons == 14);
  CHECK(describe_calibration(sticks[2]) == "-");
}

TEST_CASE("a wheel with motors but without Y is listed with the reason why it cannot be the lever") {
  const TempFolder folder;
  const UsbHidDevice wheel = usb_device("switchscience-ffb-steering-go", 0x2e8a, 0x1083, "Steering GO", "1-1");
  const std::vector<ListedStick> sticks = list_sticks({&wheel, 1}, folder.path());
  REQUIRE(sticks.size() == 1);
  CHECK(sticks[0].force == StickForce::force_feedback);
  CHECK(
      sticks[0].problem ==
      "Steering GO: its motors cannot drive the lever, because it has no axes X and Y; without its forces it may be a "
      "pedal, a button or a lever: gearshift devices --controls");
  CHECK_THROWS_WITH(check_has_forces(sticks[0]), sticks[0].problem.c_str());
}

TEST_CASE("a device that uses the force page only for rumble is distinguished from one with force feedback") {
  // A pad with the axes X and Y. Like an Xbox pad, it has only one output on the force page (0x0F): a magnitude (usage
  // 0x70) inside a collection of usage 0x21. It has no effect block.
  UsbHidDevice pad = usb_device("", 0x045e, 0x0b13, "Pad", "1-1");
  pad.report_descriptor = {0x05, 0x01, 0x09, 0x05, 0xA1, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15, 0x00, 0x26, 0xFF,
                           0x00, 0x75, 0x08, 0x95, 0x02, 0x81, 0x02, 0x05, 0x0F, 0x09, 0x21, 0xA1, 0x02, 0x09,
                           0x70, 0x15, 0x00, 0x25, 0x64, 0x75, 0x08, 0x95, 0x01, 0x91, 0x02, 0xC0, 0xC0};
  const std::vector<ListedStick> sticks = list_sticks({&pad, 1}, {});
  REQUIRE(sticks.size() == 1);
  CHECK(describe_forces(sticks[0]) == "rumble only");
}

TEST_CASE("a device without access rights is listed with the reason, whether its descriptor is known or not") {
  UsbHidDevice unknown = usb_device("", 0x1234, 0x5678, "Something", "1-1");
  unknown.problem = "Something may not be used";
  UsbHidDevice known = sidewinder("1-2");
  known.problem = "SideWinder may not be used";
  const std::vector<UsbHidDevice> plugged{unknown, known};
  const std::vector<ListedStick> sticks = list_sticks(plugged, {});
  REQUIRE(sticks.size() == 2);
  CHECK(describe_forces(sticks[0]) == "unknown");
  CHECK(sticks[0].problem == "Something may not be used");
  CHECK(sticks[1].axes > 2);
  CHECK(sticks[1].problem == "SideWinder may not be used");
}

TEST_CASE("a descriptor that cannot be parsed affects only its own device") {
  UsbHidDevice damaged = sidewinder("1-1");
  damaged.report_descriptor.resize(100);
  const std::vector<UsbHidDevice> plugged{damaged, openffboard()};
  const std::vector<ListedStick> sticks = list_sticks(plugged, {});
  REQUIRE(sticks.size() == 2);
  CHECK(sticks[0].problem.starts_with("SideWinder Force Feedback 2 Joystick: "));
  CHECK(sticks[1].problem.empty());
}

TEST_CASE("the table of a calibration separates its columns, and says what was not measured") {
  DeviceCalibration calibration;
  for (LeverAxisCalibration* axis : {&calibration.select, &calibration.shift}) {
    axis->handle = {10.123, 123.4, 12345.0};
    axis->constant_limit = 1.0;
  }
  calibration.shift.friction = 0.114;
  std::string table;
  for (const std::string& row : calibration_table(calibration)) {
    CHECK(row.size() < 100);
    table += row + "\n";
  }
  const auto shows = [&table](const char* pattern) { return std::regex_search(table, std::regex(pattern)); };
  INFO(table);
  CHECK(shows("\n  handle  +10.123 kg, 123.4 N s/m, 12345 N/m  +10.123 kg"));
  CHECK(shows("\n  dry friction  +none  +0.11 N\n"));
  CHECK(shows("\n  even forces  +up to 100 % of the magnitude  +up to 100 %"));
  CHECK(shows("\n  springs  +not measured  +not measured\n"));
  CHECK(shows("\n  dead band  +not measured  +not measured\n"));
}

TEST_CASE("how an unfinished, a complete and a damaged calibration are described") {
  const TempFolder folder;
  const UsbHidDevice device = sidewinder();
  const auto listed = [&] { return list_sticks({&device, 1}, folder.path()).at(0); };
  KnownStick known;
  known.calibration.vendor = 0x045e;
  known.calibration.product = 0x001b;
  known.calibration.name = device.identity.name;
  known.report_descriptor = device.report_descriptor;
  for (LeverAxisCalibration* axis : {&known.calibration.select, &known.calibration.shift}) {
    axis->low = -512;
    axis->high = 511;
    axis->travel = 0.14;
    axis->full_force = 15.0;
  }
  known.calibration.shift.usage = 0x31;
  const std::filesystem::path file = save_known_stick(known, folder.path());
  CHECK(describe_calibration(listed()) == "incomplete: delay, force direction missing");
  known.calibration.timing = {0.001, 0.001, 0.003, 0.0005};
  known.calibration.select.constant_sign = known.calibration.shift.constant_sign = 1;
  save_known_stick(known, folder.path());
  CHECK(describe_calibration(listed()) == "yes");
  std::ofstream(file) << "nonsense = 1\n";
  CHECK(describe_calibration(listed()) == "no");
  CHECK(listed().problem.find(file.string()) != std::string::npos);
  CHECK(listed().missing == "range, travel and force, delay, force direction");
  const std::vector<ListedStick> plugged{listed()}, none;
  CHECK(absent_problems(plugged, folder.path()).empty());  // list_sticks() already reports this file's problem
  CHECK(absent_problems(none, folder.path()) == std::vector{listed().problem});
  known.calibration.product = 0x001c;  // a different product's calibration, stored under this stick's file name
  std::filesystem::copy_file(save_known_stick(known, folder.path()), file,
                             std::filesystem::copy_options::overwrite_existing);
  CHECK(describe_calibration(listed()) == "no");
  CHECK(listed().problem == file.string() +
                                ": this file is the calibration of 045e:001c, not of 045e:001b; delete the file and "
                                "calibrate the stick again");
  UsbHidDevice forbidden = device;  // missing access rights are reported before other problems
  forbidden.problem = "it may not be used";
  CHECK(list_sticks({&forbidden, 1}, folder.path()).at(0).problem == "it may not be used");
}
