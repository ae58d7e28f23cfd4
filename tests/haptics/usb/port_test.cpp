#include <doctest/doctest.h>

#include "tests/haptics/usb/usb_rig.h"

namespace gearshift::test {
namespace {

using Bytes = UsbGadget::Bytes;

Bytes bytes_of(const haptics::HidBytes& report) {
  return {report.view().begin(), report.view().end()};
}

}  // namespace

TEST_CASE("the kernel driver is detached while a port is open, and attached again") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  {
    const auto port = rig.open();
    CHECK_FALSE(rig.usb.driver_bound(rig.gadget));
    CHECK(port->identity().name == "Plain joystick");
    CHECK(port->report_descriptor() == rig.gadget.report_descriptor());
    CHECK(sentence_of<haptics::HidError>([&] { rig.open(); }) ==
          "Plain joystick (1209:0001) is used by another program; close that program");
  }
  CHECK(rig.usb.driver_bound(rig.gadget));
  const UsbNodeCounts counts = rig.usb.counts(rig.gadget);
  CHECK(counts.claims == counts.releases);
  CHECK(counts.detached == counts.attached);
  CHECK(counts.submitted == counts.returned);
  CHECK(counts.misuses == 0);
}

// HID 1.11 sections 7.2.1, 7.2.2 and 8: on the bus a report begins with its ID, but only if the device uses report IDs.
TEST_CASE("reports carry their ID first; without report IDs it is 0 and not sent") {
  for (const bool numbered : {true, false}) {
    CAPTURE(numbered);
    UsbRig rig;
    rig.gadget.numbered = numbered;
    rig.usb.plug(rig.gadget);
    const auto port = rig.open();
    const std::uint8_t id = numbered ? 2 : 0;
    CHECK(bytes_of(port->get_feature(id, 5)) == Bytes{id, 10, 20, 30, 40});
    CHECK(bytes_of(port->get_feature(id, 3)) == Bytes{id, 10, 20});
    port->set_feature(report_of({id, 1, 2, 3, 4}));
    REQUIRE(rig.gadget.features.size() == 1);
    CHECK(rig.gadget.features[0].bytes == (numbered ? Bytes{2, 1, 2, 3, 4} : Bytes{1, 2, 3, 4}));
    const std::uint8_t out = numbered ? 5 : 0;
    port->send(report_of({out, 1, 2, 3, 4, 5, 6, 7}));
    REQUIRE(rig.gadget.outputs.size() == 1);
    CHECK(rig.gadget.outputs[0].bytes == (numbered ? Bytes{5, 1, 2, 3, 4, 5, 6, 7} : Bytes{1, 2, 3, 4, 5, 6, 7}));
  }
}

TEST_CASE("an answer may be shorter than requested") {
  UsbRig rig;
  rig.gadget.feature = {2, 10};
  rig.usb.plug(rig.gadget);
  CHECK(bytes_of(rig.open()->get_feature(2, 5)) == Bytes{2, 10});
}

TEST_CASE("without an interrupt OUT endpoint, outputs go by SET_REPORT") {
  UsbRig rig;
  rig.gadget.has_out = false;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  port->send(report_of({5, 1, 2, 3, 4, 5, 6, 7}));
  REQUIRE(rig.gadget.outputs.size() == 1);
  CHECK(rig.gadget.outputs[0].bytes == Bytes{5, 1, 2, 3, 4, 5, 6, 7});
}

TEST_CASE("a refusal is one sentence, and the next request works") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  rig.usb.set_faults(rig.gadget, {.output_stalls = 1});
  CHECK(sentence_of<haptics::HidError>([&] {
          port->send(report_of({5, 1}));
        }) == "Plain joystick (1209:0001) refused the request when sending output report 5");
  CHECK(sentence_of<haptics::HidError>([&] { port->send(report_of({5, 1})); }).empty());
}

TEST_CASE("a device that does not answer is waited for 250 ms, not longer") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  rig.usb.set_faults(rig.gadget, {.output_stuck = true, .control_stuck = true});
  const auto start = std::chrono::steady_clock::now();
  CHECK(sentence_of<haptics::HidError>([&] { static_cast<void>(port->get_feature(2, 5)); }) ==
        "Plain joystick (1209:0001) did not answer within 250 ms when getting feature report 2");
  CHECK(sentence_of<haptics::HidError>([&] {
          port->set_feature(report_of({2, 1}));
        }) == "Plain joystick (1209:0001) did not answer within 250 ms when setting feature report 2");
  CHECK(sentence_of<haptics::HidError>([&] {
          port->send(report_of({5, 1}));
        }) == "Plain joystick (1209:0001) did not answer within 250 ms when sending output report 5");
  const auto took = std::chrono::steady_clock::now() - start;
  CHECK(took >= std::chrono::milliseconds(3 * 250 - 5));
  CHECK(took < std::chrono::milliseconds(2 * 3 * 250));
  rig.usb.set_faults(rig.gadget, {});
  CHECK(port->get_feature(2, 5).size == 5);
}

TEST_CASE("a slow device is waited for") {
  UsbRig rig;
  rig.gadget.delay = 0.1;
  rig.usb.plug(rig.gadget);
  CHECK(bytes_of(rig.open()->get_feature(2, 5)) == rig.gadget.feature);
}

TEST_CASE("after an unplug every request reports that the device is gone") {
  UsbRig rig;
  rig.usb.plug(rig.gadget);
  const auto port = rig.open();
  rig.usb.unplug(rig.gadget);
  const std::string expected = "Plain joystick (1209:0001) was unplugged";
  CHECK(sentence_of<haptics::HidDisconnected>([&] { static_cast<void>(port->get_feature(2, 5)); }) == expected);
  CHECK(sentence_of<haptics::HidDisconnected>([&] { port->set_feature(report_of({2, 1})); }) == expected);
  CHECK(sentence_of<haptics::HidDisconnected>([&] { port->send(report_of({5, 1})); }) == expected);
  RecordingStream stream;
  CHECK(sentence_of<haptics::HidDisconnected>([&] { port->stream(stream.config(), stream); }) == expected);
}

TEST_CASE("an invalid report descriptor is refused, and the kernel driver is attached again") {
  UsbRig rig;
  SUBCASE("none is declared") {
    rig.gadget.declared_length = 0;
    rig.usb.plug(rig.gadget);
    CHECK(sentence_of<haptics::HidError>([&] { rig.open(); }) ==
          "Plain joystick (1209:0001) declares a report descriptor of 0 bytes, but 1 to 4096 bytes are allowed");
  }
  SUBCASE("it breaks off") {
    rig.gadget.declared_length = 20;
    rig.usb.plug(rig.gadget);
    const std::string sentence = sentence_of<haptics::HidError>([&] { rig.open(); });
    CHECK(sentence.starts_with("Plain joystick (1209:0001) cannot be used, because "));
  }
  CHECK(rig.usb.driver_bound(rig.gadget));
  CHECK(rig.usb.counts(rig.gadget).claims == rig.usb.counts(rig.gadget).releases);
}

}  // namespace gearshift::test
