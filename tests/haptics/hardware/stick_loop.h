// Test bench with the complete chain on a virtual clock: hand, emulated stick, driver and haptic loop.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "haptics/hardware/pid_lever.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/haptic_loop.h"
#include "tests/haptics/hardware/calibrated.h"
#include "tests/haptics/hardware/stick_bench.h"
#include "tests/support/gates.h"

namespace gearshift::test {

inline haptics::Gate stick_gate(const std::string& name, const EmulatedStickConfig& config) {
  return haptics::compile_gate(haptics::read_gate_layout(GEARSHIFT_ASSETS "/gates/" + name + ".toml"),
                               glm::dvec2(config.half_travel));
}

struct StickLoop : StickBench {
  StickLoop(const EmulatedStickConfig& config, const haptics::DeviceCalibration& known,
            const haptics::HapticConfig& haptics, const haptics::Gate& gate, haptics::HandDriver& hand)
      : StickBench(config, hand),
        lever((prepare(), known), driver, haptics::period_s(haptics)),
        loop(haptics, gate, lever, load, inputs) {
    period_ns = gearshift::haptics::period_ns(haptics);
    stream = driver.stream_config(period_ns);
  }
  StickLoop(const EmulatedStickConfig& config, haptics::HandDriver& hand)
      : StickLoop(config, calibration_of(config), haptics::HapticConfig{}, stick_gate("six_speed_r_left_up", config),
                  hand) {}

  const haptics::HapticSnapshot& cycle() {
    tick();
    loop.cycle(now_ns, 0);
    detector.update(loop.published(), events);
    return loop.snapshot();
  }
  void cycle_for(double seconds) {
    for (const std::int64_t end = now_ns + static_cast<std::int64_t>(1e9 * seconds); now_ns < end;) cycle();
  }
  // Returns the gears engaged since the last call.
  std::vector<int> gears() {
    std::vector<int> engaged;
    for (const haptics::HapticEvent& event : std::exchange(events, {})) {
      if (event.kind == haptics::EventKind::gear_engaged) engaged.push_back(static_cast<int>(event.value));
    }
    return engaged;
  }

  haptics::NoLoad load;
  haptics::LoopInputs inputs;
  haptics::PidLever lever;
  haptics::HapticLoop loop;
  haptics::EventDetector detector;
  std::vector<haptics::HapticEvent> events;
};

}  // namespace gearshift::test
