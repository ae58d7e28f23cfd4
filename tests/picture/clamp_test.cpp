// Tests the pseudo-haptic clamp: when the hand pushes through a wall, the drawn knob stays at the wall.
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/runtime/runtime.h"
#include "tests/picture/cabin_rig.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;

TEST_CASE("a lever point 15 mm beyond a wall does not change the picture until the ghost is shown") {
  RenderConfig config;
  config.width = 320;
  config.height = 240;
  CabinRig rig(config);
  const View view = cabin_view(camera("lever"), config);
  StageInput at_wall = resting_in(rig.gate, 3);
  const Image rested = rig.picture(at_wall, view);
  StageInput through = at_wall;
  through.lever.lever.y += 0.015;
  CHECK(difference(rig.picture(through, view), rested, 0).fraction_beyond == 0.0);

  through.lever.lever.y += 0.010;
  through.lever.flags |= kFlagGhost;
  CHECK(difference(rig.picture(through, view), rested, 3).fraction_beyond > 0.01);
}

TEST_CASE("the drawn knob is where the exact kinematics put the proxy") {
  RenderConfig config;
  config.width = 320;
  config.height = 240;
  CabinRig rig(config);
  // tip(p) below: the lever's tip is on the yoke's sphere above the plane point p, so its height is sqrt(rho^2 -
  // |p|^2), with radius rho. Select is the cabin's +X axis, shift the -Z axis.
  rig.stage.place(resting_in(rig.gate, kNeutralGear));
  const StageConfig cabin = open_gate_cabin();
  const double rho = cabin.yoke.radius;
  const glm::dvec2 neutral = rest_position(rig.gate, kNeutralGear);
  const auto tip = [rho](glm::dvec2 p) { return glm::dvec3(p.x, std::sqrt(rho * rho - p.x * p.x - p.y * p.y), -p.y); };
  const glm::dvec3 centre = rig.stage.knob() - tip(neutral);
  for (const Slot& slot : slots(rig.gate)) {
    StageInput input = resting_in(rig.gate, slot.gear);
    const glm::dvec2 inwards = input.lever.proxy;
    input.lever.lever = inwards + glm::dvec2(0.015, 0.0);  // 15 mm beyond the wall of the slot
    rig.stage.place(input);
    CHECK(glm::distance(rig.stage.knob(), centre + tip(inwards)) < 0.5e-3);
    CHECK(glm::distance(rig.stage.ghost_knob(), centre + tip(input.lever.lever)) < 0.5e-3);
  }
}

// Tests loop, stage and picture together. An arm moves the lever into third and leans against the slot's wall with far
// more force than the motors can produce.
TEST_CASE(
    "pushed 15 mm through a wall while the loop runs, the lever is still drawn in the slot, apart from the hand") {
  RuntimeConfig running;
  running.layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  running.preset.lever.hand = kArmHand;
  running.clock = RuntimeClock::virtual_time;
  Runtime runtime(running);
  runtime.arm();
  runtime.set_hand({.position = {0.0, 0.045}});
  runtime.advance(1.0);
  runtime.set_hand({.position = {0.055, 0.034}, .push = {40.0, 0.0}});
  runtime.advance(1.0);
  StageInput input;
  input.lever = runtime.snapshot();
  REQUIRE(input.lever.gear == 3);
  REQUIRE(glm::distance(input.lever.lever, input.lever.proxy) > 0.015);

  RenderConfig config;
  config.width = 320;
  config.height = 240;
  CabinRig rig(config);
  CHECK(in_free_space(rig.gate, input.lever.proxy, 1e-9));
  rig.stage.place(resting_in(rig.gate, kNeutralGear));
  const double rho = open_gate_cabin().yoke.radius;
  const auto tip = [rho](glm::dvec2 p) { return glm::dvec3(p.x, std::sqrt(rho * rho - p.x * p.x - p.y * p.y), -p.y); };
  const glm::dvec3 centre = rig.stage.knob() - tip(rest_position(rig.gate, kNeutralGear));
  rig.stage.place(input);
  CHECK(glm::distance(rig.stage.knob(), centre + tip(input.lever.proxy)) < 0.5e-3);

  // Without the ghost hand (flags 0), the pushed lever must look exactly like a lever that is not pushed.
  const View view = cabin_view(camera("lever"), config);
  StageInput unpushed = input;
  unpushed.lever.lever = input.lever.proxy;
  unpushed.lever.flags = input.lever.flags = 0;
  CHECK(difference(rig.picture(input, view), rig.picture(unpushed, view), 0).fraction_beyond == 0.0);
}
