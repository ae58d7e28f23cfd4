#include <sys/fsuid.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "tests/haptics/usb/usb_rig.h"

namespace gearshift::test {
namespace {

// Makes this thread access files as an unprivileged user, so that the tests also work as root.
class UnprivilegedThread {
 public:
  UnprivilegedThread() : before_(setfsuid(65534)) {}
  ~UnprivilegedThread() { setfsuid(static_cast<uid_t>(before_)); }
  UnprivilegedThread(const UnprivilegedThread&) = delete;
  UnprivilegedThread& operator=(const UnprivilegedThread&) = delete;

 private:
  int before_;
};

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a device is listed under its own name, and its kernel driver stays attached") {
  PlainGadget hub;
  UsbRig rig;
  hub.interface_class = 9;
  rig.usb.plug(hub, {.place = "1-1"});
  rig.usb.plug(rig.gadget, {.place = "1-1.2"});
  const std::vector<haptics::UsbHidDevice> devices = haptics::usb_hid_devices();
  REQUIRE(devices.size() == 1);
  CHECK(devices[0].identity.vendor == 0x1209);
  CHECK(devices[0].identity.product == 0x0001);
  CHECK(devices[0].identity.maker == "Plain maker");
  CHECK(devices[0].identity.name == "Plain joystick");
  CHECK(devices[0].identity.serial == "A1");
  CHECK(devices[0].identity.place == "1-1.2");
  CHECK(devices[0].interface == 0);
  CHECK(devices[0].problem.empty());
  CHECK(devices[0].report_descriptor == rig.gadget.report_descriptor());
  CHECK(rig.usb.driver_bound(rig.gadget));
  CHECK(rig.usb.counts(rig.gadget).detached == 0);
  CHECK(rig.usb.counts(rig.gadget).claims == 0);
}

TEST_CASE("a device without a driver is queried, and offered to the kernel's drivers afterwards") {
  UsbRig rig;
  rig.usb.plug(rig.gadget, {.driver_bound = false});
  const std::vector<haptics::UsbHidDevice> devices = haptics::usb_hid_devices();
  REQUIRE(devices.size() == 1);
  CHECK(devices[0].problem.empty());
  CHECK(devices[0].report_descriptor == rig.gadget.report_descriptor());
  const UsbNodeCounts counts = rig.usb.counts(rig.gadget);
  CHECK(counts.claims == 1);
  CHECK(counts.releases == 1);
  CHECK(counts.detached == 0);
  CHECK(counts.misuses == 0);
  CHECK(rig.usb.driver_bound(rig.gadget));
}

TEST_CASE("a missing permission is one sentence that names the udev rule; the device is listed anyway") {
  UsbRig rig;
  rig.usb.plug(rig.gadget, {.permitted = false});
  std::vector<haptics::UsbHidDevice> devices;
  std::string refused;
  {
    const UnprivilegedThread unprivileged;
    devices = haptics::usb_hid_devices();
    refused = sentence_of<haptics::HidError>([&] { static_cast<void>(haptics::open_usb_hid(plain_identity())); });
  }
  const std::string expected =
      "Plain joystick (1209:0001) may not be used by this user; install the udev rule assets/udev/70-gearshift.rules "
      "as described in its first lines, and plug the device in again";
  CHECK(refused == expected);
  REQUIRE(devices.size() == 1);
  CHECK(devices[0].problem == expected);
  CHECK(devices[0].report_descriptor == rig.gadget.report_descriptor());
}

TEST_CASE("the udev rule ships, and lists the emulated sticks that exist as hardware") {
  const std::string rule = text_of(std::filesystem::path(GEARSHIFT_ASSETS) / "udev" / "70-gearshift.rules");
  for (const char* stick : {R"(ATTR{idVendor}=="045e", ATTR{idProduct}=="001b")",     // SideWinder Force Feedback 2
                            R"(ATTR{idVendor}=="1209", ATTR{idProduct}=="ffb0")"}) {  // OpenFFBoard
    CHECK_MESSAGE(rule.find(stick) != std::string::npos, stick);
  }
  CHECK(rule.find(R"(TAG+="uaccess")") != std::string::npos);
}

TEST_CASE("a device in use by another program is reported as such") {
  UsbRig rig;
  rig.usb.plug(rig.gadget, {.in_use = true});
  const std::string expected = "Plain joystick (1209:0001) is used by another program; close that program";
  const std::vector<haptics::UsbHidDevice> devices = haptics::usb_hid_devices();
  REQUIRE(devices.size() == 1);
  CHECK(devices[0].problem == expected);
  CHECK(devices[0].report_descriptor.empty());
  CHECK(sentence_of<haptics::HidError>([&] { static_cast<void>(haptics::open_usb_hid(plain_identity())); }) ==
        expected);
}

TEST_CASE("unprintable characters in a device's name are replaced") {
  UsbRig rig;
  rig.gadget.name = "Evil\x1b[2J stick";
  rig.gadget.serial = "";
  rig.usb.plug(rig.gadget);
  const std::vector<haptics::UsbHidDevice> devices = haptics::usb_hid_devices();
  REQUIRE(devices.size() == 1);
  CHECK(devices[0].identity.name == "Evil?[2J stick");
  CHECK(devices[0].identity.serial.empty());
}

TEST_CASE("only HID interfaces are listed, in the order of their places") {
  PlainGadget disk, second;
  UsbRig rig;
  disk.interface_class = 8;
  second.serial = "B2";
  rig.usb.plug(second, {.place = "1-3"});
  rig.usb.plug(disk, {.place = "1-2"});
  rig.usb.plug(rig.gadget, {.place = "1-1"});
  const std::vector<haptics::UsbHidDevice> devices = haptics::usb_hid_devices();
  REQUIRE(devices.size() == 2);
  CHECK(devices[0].identity.serial == "A1");
  CHECK(devices[1].identity.serial == "B2");
}

TEST_CASE("of two identical devices, serial number or port path select the one to open") {
  PlainGadget second;
  UsbRig rig;
  second.serial = "B2";
  rig.usb.plug(rig.gadget, {.place = "1-1"});
  rig.usb.plug(second, {.place = "1-2"});
  haptics::HidIdentity wanted = plain_identity();
  wanted.serial = "B2";
  CHECK(haptics::open_usb_hid(wanted)->identity().place == "1-2");
  wanted.serial.clear();
  wanted.place = "1-1";
  CHECK(haptics::open_usb_hid(wanted)->identity().serial == "A1");
  wanted.place = "1-7";
  CHECK(sentence_of<haptics::HidDisconnected>([&] { static_cast<void>(haptics::open_usb_hid(wanted)); }) ==
        "the USB device 1209:0001 is not plugged in");
  wanted.place.clear();
  CHECK(sentence_of<haptics::HidDisconnected>([&] { static_cast<void>(haptics::open_usb_hid(wanted, 1)); }) ==
        "the USB device 1209:0001 is not plugged in");
}

}  // namespace gearshift::test
