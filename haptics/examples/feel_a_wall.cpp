// Example of the haptics library; needs no other part of this project. A simulated hand presses a simulated lever
// against a wall of a gate. Prints how deep the lever is in the wall, and the wall's force.
#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "haptics/device/pushing_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/loop/haptic_loop.h"

namespace haptics = gearshift::haptics;

// A gate with two columns. The neutral column has only a forward slot; its back side is a wall.
constexpr const char* kLayout = R"(
name = "Two columns"
[[column]]
position_mm = 0
forward = "1"
neutral = true
[[column]]
position_mm = 40
forward = "2"
back = "3"
)";

int main() {
  haptics::HapticConfig config;  // defaults: loop rate 1 kHz, wall stiffness 5000 N/m
  const std::int64_t period = haptics::period_ns(config);

  // Once the forces have ramped up, a hand pulls back with up to 15 N.
  haptics::PushingHand hand(
      [](double time, glm::dvec2) { return glm::dvec2(0.0, -15.0 * std::clamp(time - 1.0, 0.0, 1.0)); });
  haptics::SimulatedLeverConfig joystick;
  joystick.hand = haptics::kGripHand;
  haptics::SimulatedLever lever(joystick, period, hand);

  const haptics::GateLayout layout = haptics::parse_gate_layout(kLayout, "two_columns.toml");
  const haptics::Gate gate = haptics::compile_gate(layout, lever.spec().workspace);

  haptics::NoLoad no_load;
  haptics::LoopInputs inputs;  // for other threads: tuning, controls and commands
  haptics::HapticLoop loop(config, gate, lever, no_load, inputs);
  loop.arm();  // allowed only because the lever is simulated; a real lever must be armed by the user

  std::printf("time [s]  depth [mm]  wall force [N]\n");
  for (int cycle = 0; cycle <= 2500; ++cycle) {
    loop.cycle(cycle * period, 0);
    const haptics::HapticSnapshot& now = loop.snapshot();
    if (cycle % 250 == 0)
      std::printf("%8.3f  %10.3f  %14.2f\n", 1e-9 * static_cast<double>(now.time_ns), 1e3 * (now.proxy.y - now.lever.y),
                  now.wall_force.y);
  }
  // At rest the wall force is a little less than the push of 15 N, because the lever's own spring and the gate's
  // centring also resist the push. So the lever is slightly less than 15 N / (5000 N/m) = 3 mm deep in the wall.
  const haptics::HapticSnapshot& rest = loop.snapshot();
  const bool holds = rest.wall_force.y > 13.0 && rest.wall_force.y < 15.0;
  std::printf("%s\n", holds ? "the wall holds the hand back" : "the wall does not hold the hand back");
  return holds ? 0 : 1;
}
