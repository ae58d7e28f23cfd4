#include "haptics/loop/simulated_run.h"

#include "haptics/gate/lockout.h"

namespace gearshift::haptics {
namespace {

SimulatedLever placed_lever(const SimulatedRunConfig& config, HandDriver& driver) {
  SimulatedLever lever(config.lever, period_ns(config.haptics), driver);
  lever.place(config.start);
  return lever;
}

}  // namespace

SimulatedRun::SimulatedRun(const SimulatedRunConfig& config, HandDriver& driver, LeverLoad* load)
    : period_ns_(period_ns(config.haptics)),
      lever_(placed_lever(config, driver)),
      loop_(config.haptics, config.gate, lever_, load ? *load : no_load_, inputs_) {
  if (has_brake_lockout(config.gate)) {
    DriverControls controls;
    controls.pedals.brake = 1.0;
    inputs_.controls.write(controls);
  }
  loop_.arm();
}

const HapticSnapshot& SimulatedRun::step() noexcept {
  loop_.cycle(now_ns_, 0);
  now_ns_ += period_ns_;
  return loop_.snapshot();
}

}  // namespace gearshift::haptics
