// The plots of forces and the clip meter, read from the triangles that they draw.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/panel/clip_meter.h"
#include "app/ui/panel/force_plots.h"
#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/support/gates.h"

using namespace gearshift;
using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

constexpr double kWidth = 1000.0, kHeight = 600.0;  // [px]

// The plots after seven seconds of constant values, so that every curve is level over its whole width.
struct Plots {
  UiContext ui;
  Gate gate = paper_gate();
  Controls controls;
  ForcePlots plots;
  Trail trail;
  HapticSnapshot now;

  explicit Plots(const HapticSnapshot& steady) : now(steady) {
    for (now.time_ns = 0; now.time_ns < 7'000'000'000; now.time_ns += 4'000'000) {
      plots.push(now);
      trail.push(now);
    }
    draw();
  }
  void draw() {
    draw_in_window(ui, {static_cast<float>(kWidth), static_cast<float>(kHeight)}, [this] {
      controls.begin_frame();
      plots.draw_axis_choice(controls);
      plots.draw(controls, static_cast<float>(kHeight) - 40.0f, gate, now, trail);
    });
  }
  void choose_select() {
    UiEvents events;
    const ControlRect button = controls.rect("axis_select").value();
    events.mouse = 0.5 * (button.min + button.max);
    for (const bool down : {false, true, false, false}) {
      events.mouse_down[0] = down;
      ui.feed(events);
      draw();
    }
  }
};

// [px] The height y of a level curve, read near the right edge, where no legend is.
double level_of(ImU32 colour) {
  std::vector<glm::dvec2> corners = drawn_in(colour);
  std::erase_if(corners, [](glm::dvec2 corner) { return corner.x < 0.8 * kWidth; });
  const PixelBox box = box_of(corners);
  CHECK(box.max.y - box.min.y < 4.0);
  return box.middle().y;
}

HapticSnapshot steady() {
  HapticSnapshot s;
  s.f_h = {12.0, 30.0};
  s.f_a = {-18.0, -22.0};
  s.f_j = {6.0, 8.0};
  s.commanded = {-4.0, 14.0};
  s.lever = {0.010, -0.020};
  s.proxy = {0.005, 0.010};
  return s;
}

HapticSnapshot with_forces(glm::dvec2 wall, glm::dvec2 feel, glm::dvec2 world) {
  HapticSnapshot s;
  s.wall_force = wall;
  s.feel_force = feel;
  s.load_force = world;
  return s;
}

struct Meter {
  UiContext ui;
  Controls controls;
  ClipMeter meter;
  DeviceSpec device;

  void draw(const HapticSnapshot& now) {
    draw_in_window(ui, {800.0f, 120.0f}, [&] {
      controls.begin_frame();
      meter.draw(controls, now, device);
    });
  }
};

}  // namespace

TEST_CASE("each force has its own colour and height, on one scale, for either axis") {
  const HapticSnapshot s = steady();
  Plots rig(s);
  for (const int axis : {1, 0}) {
    CAPTURE(axis);
    if (axis == 0) rig.choose_select();
    const double h = level_of(ui::ink::kHand), a = level_of(ui::ink::kActuator), j = level_of(ui::ink::kJoystick);
    const double px_per_n = (a - h) / (s.f_h[axis] - s.f_a[axis]);
    CHECK(px_per_n > 0.5);  // a larger force is drawn higher up
    CHECK(std::abs((j - h) - px_per_n * (s.f_h[axis] - s.f_j[axis])) < 1.5);
    const double lever = level_of(ui::ink::kLever), proxy = level_of(ui::ink::kProxy);
    CHECK((lever - proxy) * (s.proxy[axis] - s.lever[axis]) > 0.0);
  }
}

TEST_CASE("the numbers next to the curves equal the forces and positions") {
  Plots rig(steady());
  CHECK(right_of("Force") == std::vector<std::string>{"f_h30.0N", "f_a-22.0N", "f_j8.0N"});
  CHECK(right_of("Position") == std::vector<std::string>{"lever-20.0mm", "drawn10.0mm"});
  CHECK(right_of("Force at position") == std::vector<std::string>{"commanded14.0N"});
  rig.choose_select();
  CHECK(right_of("Force") == std::vector<std::string>{"f_h12.0N", "f_a-18.0N", "f_j6.0N"});
  CHECK(right_of("Position") == std::vector<std::string>{"lever10.0mm", "drawn5.0mm"});
  CHECK(right_of("Force at position") == std::vector<std::string>{"commanded-4.0N"});
}

TEST_CASE("in the plot of force against position, the dot moves right with the lever and up with the commanded force") {
  const auto dot = [](glm::dvec2 lever, glm::dvec2 commanded) {
    HapticSnapshot s = steady();
    s.lever = lever;
    s.commanded = commanded;
    Plots rig(s);
    std::vector<glm::dvec2> corners = drawn_in(ui::ink::kActuator);
    const double lowest = box_of(corners).max.y;  // [px] lower edge of the dot, the lowest shape in this colour
    std::erase_if(corners, [&](glm::dvec2 c) { return c.y < lowest - static_cast<double>(ui_em()); });
    return box_of(corners).middle();
  };
  const glm::dvec2 at = dot({0.0, 0.0}, {0.0, -9.0});
  CHECK(dot({0.0, 0.02}, {0.0, -9.0}).x > at.x + 50.0);
  CHECK(std::abs(dot({0.02, 0.0}, {5.0, -9.0}).x - at.x) < 0.1);
  CHECK(dot({0.0, 0.0}, {0.0, -4.0}).y < at.y - 5.0);
}

TEST_CASE("the clip meter's wanted force is the sum of wall, feel and load, on the axis with the larger sum") {
  Meter rig;
  const glm::dvec2 three{0.0, 3.0}, five{0.0, 5.0}, seven{0.0, 7.0}, none(0.0);
  for (const auto& [now, label] : {std::pair(with_forces(three, none, none), "wanted 3.0 N"),
                                   {with_forces(none, five, none), "wanted 5.0 N"},
                                   {with_forces(none, none, seven), "wanted 7.0 N"},
                                   {with_forces(three, five, seven), "wanted 15.0 N"},
                                   {with_forces(three, -five, none), "wanted 2.0 N"},
                                   {with_forces({-20.0, 3.0}, {-1.0, 0.0}, none), "wanted 21.0 N"}}) {
    const std::string words = label;
    CAPTURE(words);
    rig.draw(now);
    CHECK(is_drawn(words));
  }
}

TEST_CASE("the peak mark is where a bar of that force would end") {
  Meter rig;
  rig.meter.push(with_forces({0.0, 9.0}, {0.0, 14.0}, {0.0, 8.0}));
  HapticSnapshot now;
  now.f_a = {0.0, -31.0};
  rig.draw(now);
  CHECK(is_drawn("sent 31.0 N"));
  const PixelBox peak = box_of(drawn_in(ui::ink::kWarn));
  CHECK(std::abs(box_of(drawn_in(ui::ink::kActuator)).max.x - peak.middle().x) < 1.5);
  CHECK(peak.max.x - peak.min.x < 5.0);
}
