// The pseudo-haptic clamp, in the picture: the hand goes on, the knob that is seen does not.
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/trainer/trainer.h"
#include "tests/picture/cabin_rig.h"

using namespace gearshift;

TEST_CASE("the lever point 15 mm through a wall draws the same picture as none, up to the offset of the ghost") {
  RenderConfig config;
  config.width = 320;
  config.height = 240;
  CabinRig rig(config);
  const View view = seen_from(camera("lever"), config);
  StageInput at_wall = resting_in(rig.gate, 3);
  const Image rested = rig.picture(at_wall, view);
  StageInput through = at_wall;
  through.lever.lever.y += 0.015;
  CHECK(difference(rig.picture(through, view), rested, 0).share_beyond == 0.0);

  through.lever.lever.y += 0.010;
  through.lever.flags |= kFlagGhost;
  CHECK(difference(rig.picture(through, view), rested, 3).share_beyond > 0.01);
}

TEST_CASE("the drawn knob is where the exact kinematics put the proxy") {
  RenderConfig config;
  config.width = 320;
  config.height = 240;
  CabinRig rig(config);
  // Law: the tip lies on the sphere of the yoke above the plane point p, so its height is sqrt(rho^2 - |p|^2);
  // select is the cabin's X, shift its -Z.
  rig.stage.place(resting_in(rig.gate, kNeutralGear));
  const StageConfig cabin = open_gate_cabin();
  const double rho = cabin.yoke.radius;
  const glm::dvec2 neutral = rest_position(rig.gate, kNeutralGear);
  const auto tip = [rho](glm::dvec2 p) { return glm::dvec3(p.x, std::sqrt(rho * rho - p.x * p.x - p.y * p.y), -p.y); };
  const glm::dvec3 centre = rig.stage.knob() - tip(neutral);
  for (const Slot& slot : slots(rig.gate)) {
    StageInput input = resting_in(rig.gate, slot.gear);
    const glm::dvec2 inwards = input.lever.proxy;
    input.lever.lever = inwards + glm::dvec2(0.015, 0.0);  // 15 mm through the wall of the slot
    rig.stage.place(input);
    CHECK(glm::distance(rig.stage.knob(), centre + tip(inwards)) < 0.5e-3);
    CHECK(glm::distance(rig.stage.ghost_knob(), centre + tip(input.lever.lever)) < 0.5e-3);
  }
}

// Loop, stage and picture together: an arm leads the lever into third and leans on the slot's wall with far more than
// the motors give.
TEST_CASE("the running lever pushed 15 mm through a wall: the knob that is drawn stays in the slot, and off the hand") {
  TrainerConfig running;
  running.layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/paper.toml");
  running.preset.lever.hand = kArmHand;
  running.clock = TrainerClock::virtual_time;
  Trainer trainer(running);
  trainer.arm();
  trainer.set_hand({.position = {0.0, 0.045}});
  trainer.advance(1.0);
  trainer.set_hand({.position = {0.055, 0.034}, .push = {40.0, 0.0}});
  trainer.advance(1.0);
  StageInput input;
  input.lever = trainer.snapshot();
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

  // The same picture as of a lever that nobody pushes there, but for the ghost of the hand past its offset.
  const View view = seen_from(camera("lever"), config);
  StageInput unpushed = input;
  unpushed.lever.lever = input.lever.proxy;
  unpushed.lever.flags = input.lever.flags = 0;
  CHECK(difference(rig.picture(input, view), rig.picture(unpushed, view), 0).share_beyond == 0.0);
}
