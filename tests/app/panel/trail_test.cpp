#include "app/panel/trail.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "app/panel/palette.h"
#include "tests/app/panel/drawn.h"
#include "tests/app/panel/panel_rig.h"

using namespace gearshift;

namespace {

HapticSnapshot at(double time, glm::dvec2 lever) {  // [s], [m]
  HapticSnapshot snapshot;
  snapshot.time_ns = static_cast<std::int64_t>(1e9 * time);
  snapshot.lever = lever;
  return snapshot;
}

// A second of a lever that goes 1 mm a hundredth to that side.
void drive(Trail& trail, double from, double side) {
  for (int i = 0; i < 100; ++i) trail.push(at(from + 0.01 * i, {side * 1e-3 * i, 0.0}));
}

}  // namespace

TEST_CASE("a time before the last one is another run: nothing of the one before is left") {
  Trail trail;
  drive(trail, 2.0, 1.0);
  CHECK(trail.points().size() == 100);
  drive(trail, 1.5, -1.0);  // begins within the three seconds that are kept
  CHECK(trail.points().size() == 100);
  for (const TrailPoint& point : trail.points()) CHECK(point.lever.x <= 0.0);
}

TEST_CASE("a run that goes on keeps its last three seconds, each point as old as it is") {
  Trail trail;
  for (int second = 0; second < 6; ++second) drive(trail, second, 1.0);
  CHECK(trail.points().front().time == doctest::Approx(5.99 - 3.0).epsilon(0.005));
  CHECK(trail.age(trail.points().back()) == 0.0);
  CHECK(trail.age(trail.points().front()) == doctest::Approx(1.0).epsilon(0.005));
  CHECK(std::is_sorted(trail.points().begin(), trail.points().end(),
                       [](const TrailPoint& a, const TrailPoint& b) { return a.time < b.time; }));
}

// A real loop's clock goes on when another lever takes over: time alone does not tell of it.
TEST_CASE("the panel draws no way from the lever that was to the one that is") {
  PanelRig rig;
  const auto blue_corners = [&] {  // of the left column, where else only the gears' depths are in that colour
    constexpr ImU32 kInk = ~(0xffu << IM_COL32_A_SHIFT);
    const ImDrawData& data = *ImGui::GetDrawData();
    int corners = 0;
    for (int l = 0; l < data.CmdListsCount; ++l) {
      for (const ImDrawVert& vertex : data.CmdLists[l]->VtxBuffer)
        corners += (vertex.col & kInk) == (ink::kAccent & kInk) && vertex.col > kInk && vertex.pos.x < 320.0f;
    }
    return corners;
  };
  const auto show = [&](double time, glm::dvec2 lever) {
    rig.input.now = at(time, lever);
    rig.frame();
    return blue_corners();
  };
  ++rig.input.run;
  const int without = show(1.0, {-0.03, 0.0});
  for (int i = 1; i <= 30; ++i) show(1.0 + 0.01 * i, {-0.03 + 0.002 * i, 0.0});
  CHECK(show(1.31, {0.03, 0.0}) > without + 50);
  CHECK(show(1.32, {0.0, 0.0}) > without + 50);
  ++rig.input.run;
  CHECK(show(1.33, {0.0, 0.0}) == without);
  CHECK(show(1.34, {0.001, 0.0}) > without);
}
