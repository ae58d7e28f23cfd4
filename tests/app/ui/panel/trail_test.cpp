#include "app/ui/panel/trail.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

HapticSnapshot at(double time, glm::dvec2 lever) {  // [s], [m]
  HapticSnapshot snapshot;
  snapshot.time_ns = static_cast<std::int64_t>(1e9 * time);
  snapshot.lever = lever;
  return snapshot;
}

// Pushes one second of a lever that moves by 1 mm per 0.01 s, to the right if `side` is +1 and to the left if it is -1.
void drive(Trail& trail, double from, double side) {
  for (int i = 0; i < 100; ++i) trail.push(at(from + 0.01 * i, {side * 1e-3 * i, 0.0}));
}

}  // namespace

TEST_CASE("a time before the last one begins a new run, and drops the points of the previous run") {
  Trail trail;
  drive(trail, 2.0, 1.0);
  CHECK(trail.points().size() == 100);
  drive(trail, 1.5, -1.0);  // 1.5 s is before the newest time, 2.99 s, so this is a new run
  CHECK(trail.points().size() == 100);
  for (const TrailPoint& point : trail.points()) CHECK(point.lever.x <= 0.0);
}

TEST_CASE("a run keeps its last three seconds, with each point's age") {
  Trail trail;
  for (int second = 0; second < 6; ++second) drive(trail, second, 1.0);
  CHECK(trail.points().front().time == doctest::Approx(5.99 - 3.0).epsilon(0.005));
  CHECK(trail.age(trail.points().back()) == 0.0);
  CHECK(trail.age(trail.points().front()) == doctest::Approx(1.0).epsilon(0.005));
  CHECK(std::is_sorted(trail.points().begin(), trail.points().end(),
                       [](const TrailPoint& a, const TrailPoint& b) { return a.time < b.time; }));
}

// On the real clock, time does not step back when the lever is replaced, so the time alone does not show that a new run
// has begun. The panel clears the trail when `PanelInput::run` changes.
TEST_CASE("the panel draws no line from the previous lever to the new one") {
  PanelRig rig;
  // Counts blue corners in the left column. Apart from the trail, only the gears' depths have this colour there.
  const auto blue_corners = [&] {
    constexpr ImU32 kInk = ~(0xffu << IM_COL32_A_SHIFT);
    const ImDrawData& data = *ImGui::GetDrawData();
    int corners = 0;
    for (int l = 0; l < data.CmdListsCount; ++l) {
      for (const ImDrawVert& vertex : data.CmdLists[l]->VtxBuffer)
        corners += (vertex.col & kInk) == (ui::ink::kAccent & kInk) && vertex.col > kInk && vertex.pos.x < 320.0f;
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
