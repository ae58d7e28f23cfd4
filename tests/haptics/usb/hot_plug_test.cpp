#include <algorithm>
#include <filesystem>
#include <iterator>
#include <random>

#include <doctest/doctest.h>

#include "tests/haptics/usb/usb_rig.h"

namespace gearshift {
namespace {

std::ptrdiff_t entries(const char* folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}
std::ptrdiff_t open_files() {
  return entries("/proc/self/fd");
}
std::ptrdiff_t threads() {
  return entries("/proc/self/task");
}

}  // namespace

TEST_CASE("a change is told as soon as it comes, and then there is silence") {
  UsbRig rig;
  UsbBus bus;
  CHECK_FALSE(bus.wait_for_change(0));
  rig.usb.plug(rig.gadget);
  CHECK(bus.wait_for_change(5000));
  CHECK(bus.hid_devices().size() == 1);
  // Seen in the list before udev said so: then it is told twice.
  CHECK(becomes_true([&] { return !bus.wait_for_change(20); }));
  rig.usb.unplug(rig.gadget);
  CHECK(bus.wait_for_change(5000));
  CHECK(bus.hid_devices().empty());
  rig.usb.plug(rig.gadget);  // and gone and back again between two looks
  rig.usb.unplug(rig.gadget);
  rig.usb.plug(rig.gadget);
  CHECK(bus.wait_for_change(5000));
  CHECK(bus.hid_devices().size() == 1);
}

// A look at the list comes every 500 ms: what is told before is told by udev.
TEST_CASE("udev's word is heard before the next look at the list") {
  UsbRig rig;
  UsbBus bus;
  auto quickest = std::chrono::steady_clock::duration::max();
  for (int i = 0; i < 3; ++i) {
    rig.usb.plug(rig.gadget);
    const auto start = std::chrono::steady_clock::now();
    CHECK(bus.wait_for_change(5000));
    quickest = std::min(quickest, std::chrono::steady_clock::now() - start);
    rig.usb.unplug(rig.gadget);
    CHECK(becomes_true([&] { return !bus.wait_for_change(20); }));
  }
  CHECK(quickest < std::chrono::milliseconds(450));
}

TEST_CASE("a change is seen where no udev tells of it") {
  UsbRig rig;
  UsbBus bus;
  rig.usb.plug(rig.gadget, {.told = false});
  CHECK(bus.wait_for_change(5000));
  CHECK(bus.hid_devices().size() == 1);
  CHECK(rig.open() != nullptr);
  rig.usb.unplug(rig.gadget);
  CHECK(bus.wait_for_change(5000));
  CHECK(bus.hid_devices().empty());
}

TEST_CASE("a device that is plugged in again is opened again, at its place") {
  UsbRig rig;
  const UsbBus bus;
  HidIdentity wanted = plain_identity();
  for (int i = 0; i < 3; ++i) {
    rig.usb.plug(rig.gadget, {.place = "1-4"});
    const auto port = bus.open(wanted);
    wanted.place = port->identity().place;
    wanted.serial = port->identity().serial;
    rig.usb.unplug(rig.gadget);
  }
  CHECK(wanted.place == "1-4");
}

TEST_CASE("a port outlives its bus, and lists beside a stream disturb neither") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  auto bus = std::make_unique<UsbBus>();
  const auto port = bus->open(plain_identity());
  RecordingStream stream;
  Streaming streaming(*port, stream.config(), stream);
  for (int i = 0; i < 5; ++i) CHECK(bus->hid_devices().size() == 1);
  bus.reset();
  const std::size_t before = stream.input_count();
  CHECK(becomes_true([&] { return stream.input_count() > before + 10; }));
  streaming.end();
  CHECK(streaming.error().empty());
}

TEST_CASE("fifty unplugs at random moments: each is noticed, and no file and no thread is left") {
  std::mt19937 random(6);
  std::ptrdiff_t files = 0, tasks = 0;
  {
    UsbRig rig;
    for (int i = 0; i < 52; ++i) {
      if (i == 2) {  // what umockdev and libusb keep is there by now
        files = open_files();
        tasks = threads();
      }
      rig.usb.plug(rig.gadget);
      {
        const auto port = rig.open();
        RecordingStream stream;
        Streaming streaming(*port, stream.config(), stream);
        for (int k = 0; k < 20; ++k) stream.give(report_of({5, 1, 2, 3, 4, 5, 6, 7}));
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 30'000));
        rig.usb.unplug(rig.gadget);
        streaming.join();
        CHECK(streaming.gone());
      }
      CHECK(becomes_true([&] {
        const UsbNodeCounts counts = rig.usb.counts(rig.gadget);
        return counts.closed == counts.opened && counts.submitted == counts.given_back;
      }));
      CHECK(rig.usb.counts(rig.gadget).misuses == 0);
    }
    CHECK(becomes_true([&] { return open_files() <= files && threads() <= tasks; }));
    CHECK(rig.gadget.unplugs == 52);
  }
}

}  // namespace gearshift
