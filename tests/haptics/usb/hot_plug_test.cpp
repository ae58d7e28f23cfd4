#include <algorithm>
#include <filesystem>
#include <iterator>
#include <random>

#include <doctest/doctest.h>

#include "tests/haptics/usb/usb_rig.h"

namespace gearshift::test {
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

TEST_CASE("a device that is plugged in again is opened again at the same port path") {
  UsbRig rig;
  haptics::HidIdentity wanted = plain_identity();
  for (int i = 0; i < 3; ++i) {
    rig.usb.plug(rig.gadget, {.place = "1-4"});
    const auto port = haptics::open_usb_hid(wanted);
    wanted.place = port->identity().place;
    wanted.serial = port->identity().serial;
    rig.usb.unplug(rig.gadget);
  }
  CHECK(wanted.place == "1-4");
}

TEST_CASE("listing devices beside a stream disturbs neither") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = haptics::open_usb_hid(plain_identity());
  RecordingStream stream;
  Streaming streaming(*port, stream.config(), stream);
  for (int i = 0; i < 5; ++i) CHECK(haptics::usb_hid_devices().size() == 1);
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
      if (i == 2) {  // after two rounds umockdev and libusb have opened their own files
        files = open_files();
        tasks = threads();
      }
      rig.usb.plug(rig.gadget);
      {
        const auto port = rig.open();
        RecordingStream stream;
        Streaming streaming(*port, stream.config(), stream);
        for (int k = 0; k < 20; ++k) stream.queue_output(report_of({5, 1, 2, 3, 4, 5, 6, 7}));
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 30'000));
        rig.usb.unplug(rig.gadget);
        streaming.join();
        CHECK(streaming.was_disconnected());
      }
      CHECK(becomes_true([&] {
        const UsbNodeCounts counts = rig.usb.counts(rig.gadget);
        return counts.closed == counts.opened && counts.submitted == counts.returned;
      }));
      CHECK(rig.usb.counts(rig.gadget).misuses == 0);
    }
    CHECK(becomes_true([&] { return open_files() <= files && threads() <= tasks; }));
    CHECK(rig.gadget.unplugs == 52);
  }
}

}  // namespace gearshift::test
