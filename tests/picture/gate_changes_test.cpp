// A long session may change gates often: resources of the previous gate must be freed.
#include <doctest/doctest.h>

#include "tests/picture/cabin_rig.h"
#include "tests/support/memory_in_use.h"

using namespace gearshift::cabin;
using namespace gearshift::engine;
using namespace gearshift::test;

TEST_CASE("from gate to gate and back: the renderer uses no more memory than before") {
  RenderConfig config;
  config.width = 64;
  config.height = 48;
  CabinRig rig(config);
  StageConfig other = open_gate_cabin();
  other.gate = shipped_gate("six_speed_r_left_up");
  Stage beside(other, GEARSHIFT_ASSETS "/models");
  const auto change_gates = [&](int times) {
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
  const std::size_t once = change_gates(2), often = change_gates(8);
  // Sixteen changes, with a limit below the size of one scene (about 70 MB). The driver caches up to 12 MB of compiled
  // code.
  CHECK(often < once + 40'000'000);
}
