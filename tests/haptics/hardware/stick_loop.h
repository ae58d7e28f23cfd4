// The whole lever through its reports: hand, emulated stick, driver, haptic loop, on a virtual clock.
#pragma once

#include <string>
#include <vector>

#include "haptics/hardware/pid_lever.h"
#include "haptics/loop/haptic_loop.h"
#include "tests/haptics/hardware/calibrated.h"
#include "tests/haptics/hardware/stick_bench.h"
#include "tests/support/gates.h"

namespace gearshift {

inline Gate stick_gate(const std::string& name, const EmulatedStickConfig& config) {
  return compile_gate(read_gate_layout(GEARSHIFT_ASSETS "/gates/" + name + ".toml"), glm::dvec2(config.half_travel));
}

struct StickLoop : StickBench {
  StickLoop(const EmulatedStickConfig& config, const DeviceCalibration& known, const HapticConfig& haptics,
            const Gate& gate, HandDriver& hand)
      : StickBench(config, hand),
        lever((prepare(), known), driver, period_s(haptics)),
        loop(haptics, gate, lever, world, channels) {
    period_ns = gearshift::period_ns(haptics);
    stream = driver.stream_config(period_ns);
  }
  StickLoop(const EmulatedStickConfig& config, HandDriver& hand)
      : StickLoop(config, calibration_of(config), HapticConfig{}, stick_gate("six_speed_r_left_up", config), hand) {}

  const HapticSnapshot& cycle() {
    tick();
    loop.cycle(now_ns, 0);
    return loop.snapshot();
  }
  void cycle_for(double seconds) {
    for (const std::int64_t end = now_ns + static_cast<std::int64_t>(1e9 * seconds); now_ns < end;) cycle();
  }
  std::vector<int> gears() {
    std::vector<int> engaged;
    for (HapticEvent event; channels.events.pop(event);) {
      if (event.kind == EventKind::gear_engaged) engaged.push_back(static_cast<int>(event.value));
    }
    return engaged;
  }

  NullWorld world;
  LoopChannels channels;
  PidLever lever;
  HapticLoop loop;
};

}  // namespace gearshift
