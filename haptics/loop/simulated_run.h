// A whole headless trainer lever: simulated device and hand, gate, loop, on a virtual clock. Deterministic,
// and as fast as it goes.
#pragma once

#include <cstdint>

#include "haptics/device/hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

struct SimulatedRunConfig {
  HapticConfig haptics;
  SimulatedLeverConfig lever;
  Gate gate;
  glm::dvec2 start{0.0};  // [m] where the lever rests at first
};

class SimulatedRun {
 public:
  // The driver (and the world, where one is given) must outlive the run. The lever is armed.
  SimulatedRun(const SimulatedRunConfig& config, HandDriver& driver, LeverWorld* world = nullptr);

  // One period; the snapshot is that of the cycle just done.
  const HapticSnapshot& step() noexcept;

  double time() const noexcept { return 1e-9 * static_cast<double>(now_ns_); }       // [s] simulated
  double period() const noexcept { return 1e-9 * static_cast<double>(period_ns_); }  // [s]
  LoopChannels& channels() noexcept { return channels_; }
  HapticLoop& loop() noexcept { return loop_; }
  SimulatedLever& lever() noexcept { return lever_; }

 private:
  std::int64_t period_ns_;
  std::int64_t now_ns_ = 0;
  NullWorld nothing_;
  LoopChannels channels_;
  SimulatedLever lever_;
  HapticLoop loop_;
};

}  // namespace gearshift
