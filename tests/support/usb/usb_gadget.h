// A USB device as seen from its port.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/stick/emulated_stick.h"

namespace gearshift::test {

class UsbGadget {
 public:
  using Bytes = std::vector<std::uint8_t>;

  virtual ~UsbGadget() = default;
  virtual Bytes device_descriptor() const = 0;
  virtual Bytes configuration_descriptor() const = 0;  // including the interface, HID and endpoint descriptors
  virtual Bytes report_descriptor() const = 0;
  virtual std::string string_descriptor(int index) const = 0;  // 1: maker, 2: product, 3: serial number; empty: none
  virtual std::optional<Bytes> control(const UsbSetup& setup,
                                       std::span<const std::uint8_t> data) = 0;  // empty: stall
  virtual bool output(std::span<const std::uint8_t> report) = 0;                 // interrupt OUT; false: stall
  virtual std::optional<Bytes> input() = 0;                                      // interrupt IN; empty: NAK
  virtual double control_delay() const { return 0.0; }  // [s] extra duration of each control transfer
  virtual void advance(std::int64_t now_ns) = 0;        // CLOCK_MONOTONIC
  virtual void unplug() = 0;
};

// Connects an emulated stick to the bus. The stick must outlive this object. While the bus was stopped, no time passes for
// the stick: a force that a program meant for 8 ms would otherwise push for as long as the machine was busy.
class StickGadget final : public UsbGadget {
 public:
  explicit StickGadget(EmulatedStick& stick) : stick_(stick) {}

  Bytes device_descriptor() const override { return stick_.device_descriptor(); }
  Bytes configuration_descriptor() const override { return stick_.configuration_descriptor(); }
  Bytes report_descriptor() const override { return stick_.report_descriptor(); }
  std::string string_descriptor(int index) const override;
  std::optional<Bytes> control(const UsbSetup& setup, std::span<const std::uint8_t> data) override {
    return stick_.control(setup, data);
  }
  bool output(std::span<const std::uint8_t> report) override { return stick_.output(report); }
  std::optional<Bytes> input() override { return stick_.input(); }
  double control_delay() const override { return stick_.faults.slow; }
  void advance(std::int64_t now_ns) override;
  void unplug() override { stick_.unplug(); }

 private:
  EmulatedStick& stick_;
  std::int64_t last_ns_ = 0, stopped_ns_ = 0;  // of the last call; [ns] for how long the bus was stopped
};

}  // namespace gearshift::test
