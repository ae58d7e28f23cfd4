// Runs a complete lever without a display: simulated device and hand, gate and loop on a virtual clock. The run is
// deterministic and not tied to real time.
#pragma once

#include <cstdint>

#include "haptics/device/hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::haptics {

struct SimulatedRunConfig {
  HapticConfig haptics;
  SimulatedLeverConfig lever;
  Gate gate;
  glm::dvec2 start{0.0};  // [m] initial lever position
};

class SimulatedRun {
 public:
  // The driver and the load, if given, must outlive the run. The lever starts armed. Where the brake opens a lockout, it
  // is pressed.
  SimulatedRun(const SimulatedRunConfig& config, HandDriver& driver, LeverLoad* load = nullptr);

  const HapticSnapshot& step() noexcept;

  double time() const noexcept { return 1e-9 * static_cast<double>(now_ns_); }       // [s] simulated
  double period() const noexcept { return 1e-9 * static_cast<double>(period_ns_); }  // [s]
  LoopInputs& inputs() noexcept { return inputs_; }
  HapticLoop& loop() noexcept { return loop_; }
  SimulatedLever& lever() noexcept { return lever_; }

 private:
  std::int64_t period_ns_;
  std::int64_t now_ns_ = 0;
  NoLoad no_load_;
  LoopInputs inputs_;
  SimulatedLever lever_;
  HapticLoop loop_;
};

}  // namespace gearshift::haptics
