// A user moves one of several controls. The tests check which axis the detector learns, and which movements it rejects.
#include "app/ui/input/axis_detector.h"

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "app/ui/input/bound_controllers.h"
#include "tests/support/controllers.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

using Control = AxisDetector::Control;

// Two sticks with three axes each. Every axis is noisy.
struct Desk {
  std::vector<Controller> sticks{controller("Stick", {0.1f, 0.0f, 0.0f}, 0, "0a"),
                                 controller("Pedals", {0.0f, 0.9f, 0.0f}, 0, "0b")};
  double noise = 0.004;
  std::mt19937 random{3};

  std::vector<Controller> shown() {
    std::vector<Controller> now = sticks;
    for (Controller& stick : now)
      for (float& axis : stick.axes)
        axis += static_cast<float>(noise * (static_cast<double>(random() % 2001) / 1000.0 - 1.0));
    return now;
  }
  // Moves the axis linearly to the raw value `to` in 30 frames.
  void move(AxisDetector& detector, std::size_t stick, std::size_t axis, double to) {
    const float from = sticks[stick].axes[axis];
    for (int i = 1; i <= 30; ++i) {
      sticks[stick].axes[axis] = from + static_cast<float>(i) / 30.0f * (static_cast<float>(to) - from);
      detector.record_move(shown());
    }
  }
  void rest(AxisDetector& detector, int frames = 60) {
    for (int i = 0; i < frames; ++i) detector.record_rest(shown());
  }
};

std::string refusal(const AxisDetector& detector) {
  try {
    (void)detector.result();
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "learnt";
}

}  // namespace

TEST_CASE("a pedal is learnt from one press: its axis, both ends (also reversed), and a dead zone for its noise") {
  Desk desk;
  AxisDetector detector(Control::pedal);
  desk.move(detector, 1, 1, -0.7);
  desk.move(detector, 1, 1, 0.9);
  desk.rest(detector);
  const AxisBinding pedal = detector.result();
  CHECK(pedal.of.stick == "Pedals");
  CHECK(pedal.which == 0);
  CHECK(pedal.axis == 1);
  CHECK(pedal.from == doctest::Approx(0.9).epsilon(0.005));
  CHECK(pedal.to == doctest::Approx(-0.7).epsilon(0.01));
  CHECK(pedal.dead_zone == 0.02);  // the minimum, because 1.5 x noise / travel = 1.5 x 0.004 / 1.6 is smaller
  CHECK(pedal_value(pedal, 0.9 - 0.004) == 0.0);
  CHECK(pedal_value(pedal, -0.7 + 0.004) == 1.0);
}

TEST_CASE("if the pad reports an axis only after it moves, its rest is the value to which it returns") {
  Desk desk;
  desk.sticks[1].axes[2] = 0.0f;  // a pedal that rests at -1; until the pedal moves, the pad reports 0
  AxisDetector detector(Control::pedal);
  detector.record_move(desk.shown());
  desk.sticks[1].axes[2] = -0.98f;
  desk.move(detector, 1, 2, 1.0);
  desk.move(detector, 1, 2, -1.0);
  desk.rest(detector);
  CHECK(detector.result().from == doctest::Approx(-1.0).epsilon(0.005));
  CHECK(detector.result().to == doctest::Approx(1.0).epsilon(0.005));
}

// Until its first report, the kernel holds 0 for every axis: -1 here, the far end of a Logitech wheel's pedals.
TEST_CASE("the first report of a wheel moves all its pedals at once, and is no motion") {
  Desk desk;
  desk.sticks[1].axes = {-1.0f, -1.0f, -1.0f};
  AxisDetector detector(Control::pedal);
  detector.record_move(desk.shown());
  desk.sticks[1].axes = {1.0f, 1.0f, 1.0f};
  detector.record_move(desk.shown());
  desk.move(detector, 1, 2, -0.8);  // a pedal that does not reach its end
  desk.move(detector, 1, 2, 1.0);
  desk.rest(detector);
  CHECK(detector.result().axis == 2);
  CHECK(detector.result().from == doctest::Approx(1.0).epsilon(0.005));
  CHECK(detector.result().to == doctest::Approx(-0.8).epsilon(0.01));
}

TEST_CASE("a lever is learnt: the first end reached is left or back, and its rest is where it was released") {
  for (const double first : {-0.9, 0.8}) {
    Desk desk;
    AxisDetector detector(Control::lever);
    detector.record_move(desk.shown());
    desk.move(detector, 0, 0, first);
    desk.move(detector, 0, 0, first < 0.0 ? 0.8 : -0.9);
    desk.move(detector, 0, 0, 0.06);  // close to the first rest position, 0.1
    desk.rest(detector);
    const AxisBinding lever = detector.result();
    CHECK(lever.of.stick == "Stick");
    CHECK(lever.axis == 0);
    CHECK(lever.from == doctest::Approx(first).epsilon(0.01));
    CHECK(lever.to == doctest::Approx(first < 0.0 ? 0.8 : -0.9).epsilon(0.01));
    REQUIRE(lever.centre);
    CHECK(*lever.centre == doctest::Approx(0.06).epsilon(0.02));
    CHECK(lever_value(lever, 0.1) == 0.0);   // the first rest position is inside the dead zone
    CHECK(lever_value(lever, 0.02) == 0.0);  // so is 0.02, equally far on the other side of the centre, 0.06
    CHECK(std::abs(lever_value(lever, 0.3)) > 0.1);
  }
}

TEST_CASE(
    "the second of two sticks with the same name is learnt; a name that no file can hold is replaced by the GUID") {
  Desk desk;
  desk.sticks[0].name = desk.sticks[1].name = "Twin";
  AxisDetector detector(Control::pedal);
  desk.move(detector, 1, 1, -0.7);
  desk.move(detector, 1, 1, 0.9);
  desk.rest(detector);
  CHECK(detector.result().of.stick == "Twin");
  CHECK(detector.result().which == 1);
  CHECK(raw_value({}, detector.result(), desk.sticks) == static_cast<double>(desk.sticks[1].axes[1]));

  desk.sticks[1].name = "Bad\nname";
  AxisDetector again(Control::pedal);
  desk.move(again, 1, 1, -0.7);
  desk.move(again, 1, 1, 0.9);
  desk.rest(again);
  CHECK(again.result().of.stick == "0b");
  CHECK(raw_value({}, again.result(), desk.sticks) == static_cast<double>(desk.sticks[1].axes[1]));
}

TEST_CASE("invalid movements are rejected in one sentence with the remedy") {
  const auto learn = [](Control control, const auto& person) {
    Desk desk;
    AxisDetector detector(control);
    detector.record_move(desk.shown());
    person(desk, detector);
    return refusal(detector);
  };
  CHECK(learn(Control::pedal, [](Desk& desk, AxisDetector& detector) { desk.rest(detector); }) ==
        "Nothing moved. Move one control all the way and release it.");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisDetector& detector) {
          desk.move(detector, 1, 1, -0.7);
          desk.move(detector, 1, 2, -1.0);
          desk.rest(detector);
        }) == "Axis 1 of Pedals and axis 2 of Pedals moved together. Move only one control.");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisDetector& detector) {
          desk.move(detector, 1, 1, -0.7);
          desk.move(detector, 1, 1, 0.1);  // the pedal stays half pressed
          desk.rest(detector);
        }) == "Axis 1 of Pedals rests in the middle of its range. Press the pedal all the way down, then release it.");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisDetector& detector) {
          desk.move(detector, 1, 1, -0.7);
          desk.move(detector, 1, 1, 0.9);
          desk.rest(detector, 5);
        }) == "Axis 1 of Pedals was not at rest long enough. Release the control and don't touch it for a second.");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisDetector& detector) {
          desk.move(detector, 1, 1, -0.7);
          desk.move(detector, 1, 1, 0.9);
          desk.noise = 0.4;
          desk.rest(detector);
        }).find("Axis 1 of Pedals moved by 0.2") == 0);
  CHECK(learn(Control::lever,
              [](Desk& desk, AxisDetector& detector) {
                desk.move(detector, 0, 0, 0.9);
                desk.move(detector, 0, 0, 0.1);
                desk.rest(detector);
              }) ==
        "Axis 0 of Stick moved to only one side of its rest position. Move the lever to one end, then to the other.");
  CHECK(learn(Control::lever, [](Desk& desk, AxisDetector& detector) {
          desk.move(detector, 0, 0, 0.9);
          desk.sticks.pop_back();
          desk.move(detector, 0, 0, -0.9);
        }) == "A stick was plugged in or unplugged.");
  AxisDetector without_sticks(Control::pedal);
  without_sticks.record_move({});
  CHECK(refusal(without_sticks) == "No stick with an axis is plugged in. Plug one in.");
}

TEST_CASE("non-finite values are ignored") {
  Desk desk;
  AxisDetector detector(Control::pedal);
  desk.move(detector, 1, 1, -0.7);
  std::vector<Controller> broken = desk.sticks;
  broken[1].axes[1] = broken[0].axes[0] = std::nanf("");
  detector.record_move(broken);
  detector.record_rest(broken);
  desk.move(detector, 1, 1, 0.9);
  desk.rest(detector);
  CHECK(detector.result().from == doctest::Approx(0.9).epsilon(0.005));
}
