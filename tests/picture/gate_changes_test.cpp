// Tests that a change of gate frees the previous gate's resources, because a long session may change gates often.
#include <doctest/doctest.h>

#include "tests/picture/cabin_rig.h"
#include "tests/support/memory_in_use.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;

TEST_CASE("switching between two gates does not increase the memory that the renderer uses") {
  RenderConfig config;
  config.width = 64;
  config.height = 48;
  CabinRig rig(config);
  StageConfig other = open_gate_cabin();
  other.gate = shipped_gate("six_speed_r_left_up");
  Stage other_stage(other, GEARSHIFT_ASSETS "/models");
  const auto change_gates = [&](int times) {
    for (int i = 0; i < times; ++i) {
      for (Stage* stage : {&other_stage, &rig.stage}) {
        rig.renderer.set_model(stage->model());
        stage->place(resting_in(rig.gate, 1));
        const View view = cabin_view(stage->driver_eye(), config);
        rig.renderer.draw(stage->scene(), {&view, 1});
        rig.renderer.read_eye(0);
      }
    }
    return memory_in_use();
  };
  const std::size_t few_changes = change_gates(2), many_changes = change_gates(8);
  // The memory may grow by 40 MB in sixteen changes. This is less than one scene (about 70 MB), and more than the
  // compiled code that the driver caches (up to 12 MB).
  CHECK(many_changes < few_changes + 40'000'000);
}
