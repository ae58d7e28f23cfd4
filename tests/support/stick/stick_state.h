// Internals of EmulatedStick: firmware, simulated lever and time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "tests/support/stick/emulated_stick.h"
#include "tests/support/stick/stick_firmware.h"

namespace gearshift::test {

struct EmulatedStick::State {
  State(const EmulatedStickConfig& wanted, haptics::HandDriver& hand, const EmulatedFaults& wrong,
        const std::uint64_t& held);

  // Output reports act in order, each when it is due. apply_all_outputs() applies the waiting reports at once, before a
  // request that depends on them.
  bool accept_output(std::span<const std::uint8_t> report);  // false if the report is unknown
  void apply_all_outputs();
  void advance(std::int64_t to_ns);
  void power_off();
  void on_bus_reset();  // resets the device if it was unplugged

  StickReport lever_report(double error = 0.0) const;  // error [1] of X, a fraction of the full deflection
  StickReport with_faults(StickReport report);         // applies the faults

  EmulatedStickConfig config;
  const StickFamilyTable& family;
  std::vector<std::uint8_t> descriptor;
  std::int64_t period_ns, interval_ns, delay_ns;
  const EmulatedFaults& faults;
  const std::uint64_t& held_buttons;
  haptics::SimulatedLever lever;
  StickFirmware firmware;

  glm::dvec2 force{0.0};      // [N] motor force on the knob
  std::int64_t now_ns = 0;    // time on the caller's clock
  std::int64_t plant_ns = 0;  // time of the simulated lever, less than a period before now_ns
  std::int64_t fetched_ns = 0;
  std::optional<StickReport> pending_report;  // newest lever report, not fetched yet
  StickReport sent;                           // last fetched report
  std::uint8_t idle = 0, configuration = 0;
  bool unplugged = false;

 private:
  struct Pending {
    std::int64_t due_ns;
    StickReport report;
  };

  void begin(std::int64_t at_ns);
  void step();
  void apply_due_outputs();
  void apply_force();
  void sample();
  DeviceMotion motion() const;

  std::deque<Pending> outputs_;
  haptics::LeverReading reading_;
  bool started_ = false;
  std::int64_t sample_ns_ = 0;
  std::uint64_t samples_ = 0;
  StickReport stuck_;
};

}  // namespace gearshift::test
