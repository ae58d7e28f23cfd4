// Positions in the view of the gate, read from the triangles that it draws.
#include "app/ui/panel/gate_view.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/ui/panel/palette.h"
#include "haptics/gate/gate_description.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/support/gates.h"

using namespace gearshift;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

constexpr double kMaxForce = 75.0;  // [N]
// Factors that convert a vector (right, forward) in the gate to (right, down) on the screen.
constexpr glm::dvec2 kUp{1.0, -1.0};
constexpr glm::dvec2 kForces[] = {{0.0, 30.0}, {-30.0, 0.0}, {18.0, -24.0}};  // [N] each has the magnitude 30 N

struct DrawnGate {
  UiContext ui;
  Gate gate = paper_gate();
  HapticSnapshot now;
  Trail trail;

  void draw() {
    draw_in_window(ui, {640.0f, 480.0f}, [this] {
      draw_gate_view(ImGui::GetContentRegionAvail(), gate, describe_gate(gate), now, trail, kMaxForce);
    });
  }
  glm::dvec2 disc_at(glm::dvec2 proxy) {  // [px] centre of the drawn lever
    now.proxy = now.lever = proxy;
    draw();
    return box_of(drawn_in(ui::ink::kProxy)).middle();
  }
  double px_per_m() { return (disc_at({0.02, 0.0}).x - disc_at({0.0, 0.0}).x) / 0.02; }
};

double distance_from(glm::dvec2 point, glm::dvec2 wanted) {
  return glm::distance(point, wanted);
}

// [px] The vector from `from` to the tip of the arrow that starts there. The tip is the arrow's farthest corner.
glm::dvec2 tip_of(ImU32 colour, glm::dvec2 from) {
  glm::dvec2 tip = from;
  for (const glm::dvec2 corner : drawn_in(colour))
    if (glm::distance(corner, from) > glm::distance(tip, from)) tip = corner;
  return tip - from;
}

}  // namespace

TEST_CASE("in the gate view forward is up and right is right, with the same scale for both") {
  DrawnGate view;
  const double scale = view.px_per_m();
  CHECK(scale > 1000.0);
  const glm::dvec2 middle = view.disc_at({0.0, 0.0});
  for (const glm::dvec2 place : {glm::dvec2(0.0, 0.03), {0.0, -0.03}, {-0.03, 0.0}, {0.025, -0.02}})
    CHECK(distance_from(view.disc_at(place), middle + scale * kUp * place) < 0.1);
}

TEST_CASE("walls and the engaged gear's name are drawn in the same frame of reference as the lever") {
  DrawnGate view;
  for (const char* name : {"paper", "six_speed_r_left_up", "four_speed"}) {
    CAPTURE(name);
    view.gate = shipped_gate(name);
    const double scale = view.px_per_m();
    const glm::dvec2 middle = view.disc_at({0.0, 0.0});
    glm::dvec2 low(0.0), high(0.0);
    for (const WallInfo& wall : describe_gate(view.gate).walls) {
      low = glm::min(low, glm::min(wall.from, wall.to));
      high = glm::max(high, glm::max(wall.from, wall.to));
    }
    const PixelBox walls = box_of(drawn_in(ui::ink::kWall));
    const double thick = 0.16 * static_cast<double>(ui_em());
    CHECK(std::abs(walls.min.y - (middle.y - scale * high.y)) < thick);
    CHECK(std::abs(walls.max.y - (middle.y - scale * low.y)) < thick);
    for (const Slot& slot : slots(view.gate)) {
      CAPTURE(slot.gear);
      view.now.gear = slot.gear;
      view.draw();
      const glm::dvec2 disc = box_of(drawn_in(ui::ink::kAccentDeep)).middle();
      const glm::dvec2 end =
          middle +
          scale * kUp * glm::dvec2(column_of(view.gate, slot.column).center, static_cast<int>(slot.side) * slot.end);
      CHECK(std::abs(disc.x - end.x) < 0.5);
      CHECK((end.y - disc.y) * static_cast<int>(slot.side) > 0.0);  // the disc is beyond the slot's end
      const DrawnText sign = the_text(drawn_texts(), gear_name(slot.gear));
      CHECK(distance_from(sign.box.middle(), disc) < 0.4 * static_cast<double>(ui_em()));
    }
  }
}

TEST_CASE("the filled disc is the proxy, the ring the true lever, and a red line joins them") {
  DrawnGate view;
  const double scale = view.px_per_m();
  const glm::dvec2 middle = view.disc_at({0.0, 0.0});
  view.now.proxy = {-0.035, 0.030};
  view.now.lever = {-0.050, 0.038};
  view.draw();
  const glm::dvec2 drawn = middle + scale * kUp * view.now.proxy, true_one = middle + scale * kUp * view.now.lever;
  CHECK(distance_from(box_of(drawn_in(ui::ink::kProxy)).middle(), drawn) < 0.1);
  CHECK(distance_from(box_of(drawn_in(ui::ink::kLever)).middle(), true_one) < 0.1);
  const auto red_near = [](glm::dvec2 place) {
    const std::vector<glm::dvec2> red = drawn_in(ui::ink::kBad);
    return std::any_of(red.begin(), red.end(), [&](glm::dvec2 corner) { return glm::distance(corner, place) < 3.0; });
  };
  CHECK(red_near(drawn));
  CHECK(red_near(true_one));
  CHECK_FALSE(red_near(2.0 * true_one - drawn));
  view.now.flags = kFlagGhost;  // proxy and lever are too far apart, so the ring turns red
  view.draw();
  CHECK(drawn_in(ui::ink::kLever).empty());
  CHECK(red_near(true_one + glm::dvec2(0.0, 0.56 * static_cast<double>(ui_em()))));
}

TEST_CASE("arrows from the lever show f_h (hand) and the commanded force (actuators), to scale") {
  DrawnGate view;
  const glm::dvec2 lever = view.disc_at({0.0, 0.0});
  for (const bool hand : {true, false}) {
    CAPTURE(hand);
    const ImU32 colour = hand ? ui::ink::kHand : ui::ink::kActuator;
    glm::dvec2 HapticSnapshot::*const shown = hand ? &HapticSnapshot::f_h : &HapticSnapshot::commanded;
    for (const glm::dvec2 force : kForces) {
      CAPTURE(force.x);
      CAPTURE(force.y);
      view.now.f_h = view.now.f_a = view.now.f_j = view.now.commanded = view.now.wall_force = {40.0, 40.0};
      view.now.*shown = force;
      view.draw();
      const glm::dvec2 once = tip_of(colour, lever);
      CHECK(distance_from(glm::normalize(once), glm::normalize(kUp * force)) < 0.03);
      view.now.*shown = 2.0 * force;
      view.draw();
      const glm::dvec2 twice = tip_of(colour, lever);
      // The arrows for 30 N (`once`) and 60 N (`twice`) have equal tips and soft edges, so the difference of their
      // lengths is the length of exactly 30 N.
      const double px_per_n = glm::distance(twice, once) / 30.0;
      CHECK(std::abs(glm::length(once) - 30.0 * px_per_n) < 4.0);
      CHECK(75.0 * px_per_n > 100.0);  // the device's maximum force must be clearly visible
      CHECK(75.0 * px_per_n < 240.0);  // the device's maximum force must fit into the view
    }
    view.now.*shown = {0.0, 0.0};
    view.draw();
    CHECK(drawn_in(colour).empty());
  }
}
