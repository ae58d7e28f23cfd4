// What an EmulatedStick is made of: the firmware, the lever, and time between them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/stick/emulated_stick.h"
#include "tests/support/stick/stick_firmware.h"

namespace gearshift {

struct EmulatedStick::State {
  State(const EmulatedStickConfig& wanted, HandDriver& hand, const StickFaults& wrong, const std::uint64_t& held);

  // Outputs act in their order when their time has come. settle(): those that wait act at once, because a request comes
  // that builds on them.
  bool take(std::span<const std::uint8_t> report);  // false: it is not known
  void settle();
  void advance(std::int64_t to_ns);
  void power_off();
  void meet_bus();  // that it was unplugged from, too: it begins anew

  StickReport lever_report(double off = 0.0) const;  // off [1]: of the full deflection, that X is wrong
  StickReport spoiled(StickReport report);           // as its faults make it

  EmulatedStickConfig config;
  const StickFamilyTable& family;
  std::vector<std::uint8_t> descriptor;
  std::int64_t period_ns, interval_ns, delay_ns;
  const StickFaults& faults;
  const std::uint64_t& held_buttons;
  SimulatedLever lever;
  StickFirmware firmware;

  glm::dvec2 force{0.0};      // [N] on the knob
  std::int64_t now_ns = 0;    // of the caller
  std::int64_t plant_ns = 0;  // not after it, and less than a period before it
  std::int64_t told_ns = 0;
  std::optional<StickReport> waiting;  // to be fetched: the newest of the lever
  StickReport sent;                    // that was fetched last
  std::uint8_t idle = 0, configuration = 0;
  bool unplugged = false;

 private:
  struct Pending {
    std::int64_t due_ns;
    StickReport report;
  };

  void begin(std::int64_t at_ns);
  void step();
  void take_due();
  void push();
  void sample();
  DeviceMotion motion() const;

  std::deque<Pending> outputs_;
  LeverReading reading_;
  bool started_ = false;
  std::int64_t sample_ns_ = 0;
  std::uint64_t samples_ = 0;
  StickReport stuck_;
};

}  // namespace gearshift
