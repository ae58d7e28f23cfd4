// A small joystick for tests of the transport: it sends numbered input reports, records what it receives, and can be
// configured to misbehave.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/support/usb/usb_gadget.h"

namespace gearshift::test {

class PlainGadget final : public UsbGadget {
 public:
  struct ReceivedReport {
    std::int64_t time_ns = 0;
    Bytes bytes;
  };

  bool numbered = true;                // uses report IDs
  bool has_in = true, has_out = true;  // its interrupt endpoints
  double report_every = 0.001;         // [s] between input reports; 0: none unless requested
  bool answers_get_report = true;      // false: responds to GET_REPORT with STALL
  double delay = 0.0;                  // [s] duration of control transfers
  std::string serial = "A1", name = "Plain joystick";
  std::uint16_t product = 0x0001;
  std::uint8_t interface_class = 3;
  int declared_length = -1;  // [bytes] declared size of the report descriptor; -1: the true size

  std::vector<ReceivedReport> outputs;   // received on the interrupt pipe, or as SET_REPORT(output)
  std::vector<ReceivedReport> features;  // SET_REPORT(feature)
  Bytes feature{2, 10, 20, 30, 40};      // answer to GET_REPORT(feature); the first byte is the report ID
  int reports = 0;                       // number of unrequested input reports sent
  int asked = 0;                         // number of GET_REPORT(input) requests
  int idles = 0;                         // number of SET_IDLE requests
  int unplugs = 0;

  Bytes device_descriptor() const override;
  Bytes configuration_descriptor() const override;
  Bytes report_descriptor() const override;
  std::string string_descriptor(int index) const override;
  std::optional<Bytes> control(const UsbSetup& setup, std::span<const std::uint8_t> data) override;
  bool output(std::span<const std::uint8_t> report) override;
  std::optional<Bytes> input() override;
  double control_delay() const override { return delay; }
  void advance(std::int64_t now_ns) override { now_ns_ = now_ns; }
  void unplug() override { ++unplugs; }

 private:
  Bytes lever_report(int count) const;
  Bytes without_id(Bytes report) const;

  std::int64_t now_ns_ = 0, reported_ns_ = 0;
};

}  // namespace gearshift::test
