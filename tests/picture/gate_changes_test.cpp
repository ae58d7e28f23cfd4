// A long session changes gates often: whatever was drawn for the last one is given back.
#include <doctest/doctest.h>

#include "tests/picture/cabin_rig.h"
#include "tests/support/memory_in_use.h"

using namespace gearshift;

TEST_CASE("from gate to gate and back: the renderer keeps no more in use than before") {
  RenderConfig config;
  config.width = 64;
  config.height = 48;
  CabinRig rig(config);
  StageConfig other = open_gate_cabin();
  other.gate = shipped_gate("six_speed_r_left_up");
  Stage beside(other, GEARSHIFT_ASSETS "/models");
  const auto there_and_back = [&](int times) {
    for (int i = 0; i < times; ++i) {
      for (Stage* stage : {&beside, &rig.stage}) {
        rig.renderer.set_model(stage->model());
        stage->place(resting_in(rig.gate, 1));
        const View view = seen_from(stage->driver_eye(), config);
        rig.renderer.draw(stage->scene(), {&view, 1});
        rig.renderer.read_eye(0);
      }
    }
    return memory_in_use();
  };
  const std::size_t once = there_and_back(2), often = there_and_back(8);
  // Sixteen changes and less than one scene, which is some 70 MB: the driver keeps up to 12 MB of what it compiled.
  CHECK(often < once + 40'000'000);
}
