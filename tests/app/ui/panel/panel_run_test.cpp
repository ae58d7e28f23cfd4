// A new lever, a replay, and a jump within a replay are new runs for the panel: its plots and statistics start again.
#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

// [px] The width of the force curves in the left column.
double width_of_force_curve() {
  const std::vector<glm::dvec2> corners = drawn_in(ui::ink::kJoystick);
  double low = 1e9, high = -1e9;
  const PixelBox head = the_text(drawn_texts(), "Force").box, foot = the_text(drawn_texts(), "Position").box;
  for (const glm::dvec2 at : corners) {
    if (at.y < head.max.y + 2.0 || at.y > foot.min.y) continue;
    low = std::min(low, at.x);
    high = std::max(high, at.x);
  }
  return std::max(0.0, high - low);
}

HapticSnapshot pushed(double time, bool clipped) {
  HapticSnapshot snapshot;
  snapshot.time_ns = static_cast<std::int64_t>(1e9 * time);
  snapshot.f_j = {0.0, 5.0};
  snapshot.wall_force = {0.0, clipped ? 44.0 : 4.0};
  snapshot.flags = clipped ? kFlagSaturated : 0u;
  return snapshot;
}

}  // namespace

TEST_CASE("a run that begins later than the previous one is not joined to it in any plot or statistic") {
  PanelRig rig;
  for (int i = 0; i < 250; ++i) rig.input.history.push_back(pushed(10.0 + 0.004 * i, true));
  rig.input.now = pushed(11.0, true);
  rig.frame();
  rig.frame();
  CHECK(width_of_force_curve() > 20.0);
  CHECK(is_drawn("clipped 100.0 %"));
  ++rig.input.run;
  for (const double time : {12.0, 12.5, 13.0}) {  // [s] times to which a paused replay jumps
    ++rig.input.run;
    rig.input.now = pushed(time, false);
    rig.frame();
    rig.frame();
    CHECK(width_of_force_curve() == 0.0);
    CHECK(is_drawn("clipped 0.0 %"));
  }
  for (int i = 1; i < 250; ++i) rig.input.history.push_back(pushed(13.0 + 0.004 * i, false));
  rig.frame();
  rig.frame();
  CHECK(width_of_force_curve() > 20.0);
}
