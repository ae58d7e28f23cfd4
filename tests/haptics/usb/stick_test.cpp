#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/hardware/pid_driver.h"
#include "tests/haptics/usb/usb_rig.h"
#include "tests/support/stick/stick_port.h"

namespace gearshift {
namespace {

constexpr StickFamily kFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy};

EmulatedStickConfig of_family(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  return config;
}

// All that the driver tells a stick from beginning to end, one message a line.
std::string told_through(HidPort& port, const EmulatedStick& stick) {
  PidDriver driver(port.report_descriptor());
  driver.prepare(port);
  driver.finish(port);
  std::string lines;
  for (const StickMessage& message : stick.log) lines += message_line(message) + '\n';
  return lines;
}

}  // namespace

TEST_CASE("a stick hears the same over USB as it hears without: nothing is added, lost, or in another order") {
  for (const StickFamily family : kFamilies) {
    CAPTURE(stick_family_name(family));
    RestingHand hand;
    EmulatedStick direct(of_family(family), hand), plugged(of_family(family), hand);
    std::mutex mutex;
    const std::atomic<bool> there{true};
    StickPort direct_port(direct, mutex, there);

    StickGadget gadget(plugged);
    MockUsb usb;
    usb.plug(gadget);
    const std::vector<UsbHidDevice> seen = usb_hid_devices();
    REQUIRE(seen.size() == 1);
    CHECK(seen[0].report_descriptor == direct.report_descriptor());
    CHECK(seen[0].identity.name == direct_port.identity().name);
    const auto port = open_usb_hid(seen[0].identity);
    const std::string expected = told_through(direct_port, direct);
    CHECK(told_through(*port, plugged) == expected);
    CHECK(expected.size() > 100);
  }
}

TEST_CASE("a wish becomes a force on the knob, and a release ends it") {
  for (const StickFamily family : kFamilies) {
    CAPTURE(stick_family_name(family));
    RestingHand hand;
    EmulatedStick stick(of_family(family), hand);
    StickGadget gadget(stick);
    MockUsb usb;
    usb.plug(gadget);
    const auto force = [&] {
      const std::lock_guard<std::mutex> lock(usb.mutex());
      return glm::length(stick.force());
    };
    const auto port = open_usb_hid(usb_hid_devices().at(0).identity);
    PidDriver driver(port->report_descriptor());
    driver.prepare(*port);
    std::string error;
    std::thread streaming(
        [&] { error = sentence_of<HidError>([&] { port->stream(driver.stream_config(1'000'000), driver); }); });
    CHECK(becomes_true([&] { return driver.see().sequence > 0; }));
    CHECK(becomes_true([&] {
      driver.wish({.enabled = true, .constant = {0.5, 0.0}});
      driver.see();
      return force() > 1.0;
    }));
    driver.release();
    CHECK(becomes_true([&] { return force() == 0.0; }));
    driver.end();
    streaming.join();
    driver.finish(*port);
    CHECK(error.empty());
  }
}

}  // namespace gearshift
