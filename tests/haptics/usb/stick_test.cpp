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

namespace gearshift::test {
namespace {

constexpr StickFamily kFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy};

EmulatedStickConfig of_family(StickFamily family) {
  EmulatedStickConfig config;
  config.family = family;
  return config;
}

// Runs a session from prepare() to finish(). Returns all messages between driver and stick, one per line.
std::string messages_through(haptics::HidPort& port, const EmulatedStick& stick) {
  haptics::PidDriver driver(port.report_descriptor());
  driver.prepare(port);
  driver.finish(port);
  std::string lines;
  for (const StickMessage& message : stick.log) lines += message_line(message) + '\n';
  return lines;
}

}  // namespace

TEST_CASE("a stick receives the same messages over USB as without: none added, lost or reordered") {
  for (const StickFamily family : kFamilies) {
    CAPTURE(to_string(family));
    haptics::IdleHand hand;
    EmulatedStick direct(of_family(family), hand), plugged(of_family(family), hand);
    std::mutex mutex;
    const std::atomic<bool> there{true};
    StickPort direct_port(direct, mutex, there);

    StickGadget gadget(plugged);
    MockUsb usb;
    usb.plug(gadget);
    const std::vector<haptics::UsbHidDevice> devices = haptics::usb_hid_devices();
    REQUIRE(devices.size() == 1);
    CHECK(devices[0].report_descriptor == direct.report_descriptor());
    CHECK(devices[0].identity.name == direct_port.identity().name);
    const auto port = haptics::open_usb_hid(devices[0].identity);
    const std::string expected = messages_through(direct_port, direct);
    CHECK(messages_through(*port, plugged) == expected);
    CHECK(expected.size() > 100);
  }
}

TEST_CASE("a command becomes a force on the knob, and a release ends it") {
  for (const StickFamily family : kFamilies) {
    CAPTURE(to_string(family));
    haptics::IdleHand hand;
    EmulatedStick stick(of_family(family), hand);
    StickGadget gadget(stick);
    MockUsb usb;
    usb.plug(gadget);
    const auto force = [&] {
      const std::lock_guard<std::mutex> lock(usb.mutex());
      return glm::length(stick.force());
    };
    const auto port = haptics::open_usb_hid(haptics::usb_hid_devices().at(0).identity);
    haptics::PidDriver driver(port->report_descriptor());
    driver.prepare(*port);
    std::string error;
    std::thread streaming([&] {
      error = sentence_of<haptics::HidError>([&] { port->stream(driver.stream_config(1'000'000), driver); });
    });
    CHECK(becomes_true([&] { return driver.state().sequence > 0; }));
    CHECK(becomes_true([&] {
      driver.command({.enabled = true, .constant = {0.5, 0.0}});
      driver.state();
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

}  // namespace gearshift::test
