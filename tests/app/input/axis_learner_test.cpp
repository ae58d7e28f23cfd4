// A person moves one control of several; what was learnt of it, and what is refused.
#include "app/input/axis_learner.h"

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

using namespace gearshift;

namespace {

using Control = AxisLearner::Control;

// Two sticks of three axes, every axis trembling a little.
struct Desk {
  std::vector<PadState> sticks{{"Stick", {0.1f, 0.0f, 0.0f}, {}, "0a"}, {"Pedals", {0.0f, 0.9f, 0.0f}, {}, "0b"}};
  double noise = 0.004;
  std::mt19937 random{3};

  std::vector<PadState> shown() {
    std::vector<PadState> now = sticks;
    for (PadState& stick : now)
      for (float& axis : stick.axes)
        axis += static_cast<float>(noise * (static_cast<double>(random() % 2001) / 1000.0 - 1.0));
    return now;
  }
  // Straight to a raw value, in 30 frames.
  void move(AxisLearner& learner, std::size_t stick, std::size_t axis, double to) {
    const float from = sticks[stick].axes[axis];
    for (int i = 1; i <= 30; ++i) {
      sticks[stick].axes[axis] = from + static_cast<float>(i) / 30.0f * (static_cast<float>(to) - from);
      learner.watch_move(shown());
    }
  }
  void rest(AxisLearner& learner, int frames = 60) {
    for (int i = 0; i < frames; ++i) learner.watch_rest(shown());
  }
};

std::string refusal(const AxisLearner& learner) {
  try {
    (void)learner.answer();
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "learnt";
}

}  // namespace

TEST_CASE("a pedal that is pressed and let go: its axis, up and down, upside down too, and a zone for its noise") {
  Desk desk;
  AxisLearner learner(Control::pedal);
  desk.move(learner, 1, 1, -0.7);
  desk.move(learner, 1, 1, 0.9);
  desk.rest(learner);
  const AxisBinding pedal = learner.answer();
  CHECK(pedal.stick == "Pedals");
  CHECK(pedal.pad == 0);
  CHECK(pedal.axis == 1);
  CHECK(pedal.from == doctest::Approx(0.9).epsilon(0.005));
  CHECK(pedal.to == doctest::Approx(-0.7).epsilon(0.01));
  CHECK(pedal.dead_zone == 0.02);  // 1.5 x 0.004 of a way of 1.6 is less
  CHECK(pedal_value(pedal, 0.9 - 0.004) == 0.0);
  CHECK(pedal_value(pedal, -0.7 + 0.004) == 1.0);
}

TEST_CASE("an axis of which the pad tells nothing before it moves: its rest is where it comes back to") {
  Desk desk;
  desk.sticks[1].axes[2] = 0.0f;  // told so; it stands at -1
  AxisLearner learner(Control::pedal);
  learner.watch_move(desk.shown());
  desk.sticks[1].axes[2] = -0.98f;
  desk.move(learner, 1, 2, 1.0);
  desk.move(learner, 1, 2, -1.0);
  desk.rest(learner);
  CHECK(learner.answer().from == doctest::Approx(-1.0).epsilon(0.005));
  CHECK(learner.answer().to == doctest::Approx(1.0).epsilon(0.005));
}

TEST_CASE("a lever: the end that was reached first is the left or the back one; it rests where it was left") {
  for (const double first : {-0.9, 0.8}) {
    Desk desk;
    AxisLearner learner(Control::lever);
    learner.watch_move(desk.shown());
    desk.move(learner, 0, 0, first);
    desk.move(learner, 0, 0, first < 0.0 ? 0.8 : -0.9);
    desk.move(learner, 0, 0, 0.06);  // a little beside where it stood
    desk.rest(learner);
    const AxisBinding lever = learner.answer();
    CHECK(lever.stick == "Stick");
    CHECK(lever.axis == 0);
    CHECK(lever.from == doctest::Approx(first).epsilon(0.01));
    CHECK(lever.to == doctest::Approx(first < 0.0 ? 0.8 : -0.9).epsilon(0.01));
    REQUIRE(lever.centre);
    CHECK(*lever.centre == doctest::Approx(0.06).epsilon(0.02));
    CHECK(lever_value(lever, 0.1) == 0.0);   // where it stood before is at rest as well
    CHECK(lever_value(lever, 0.02) == 0.0);  // and the same on the other side
    CHECK(std::abs(lever_value(lever, 0.3)) > 0.1);
  }
}

TEST_CASE("the second of two sticks that are called the same; a name that no file can hold goes by its GUID") {
  Desk desk;
  desk.sticks[0].name = desk.sticks[1].name = "Twin";
  AxisLearner learner(Control::pedal);
  desk.move(learner, 1, 1, -0.7);
  desk.move(learner, 1, 1, 0.9);
  desk.rest(learner);
  CHECK(learner.answer().stick == "Twin");
  CHECK(learner.answer().pad == 1);
  CHECK(find_stick(desk.sticks, learner.answer()) == &desk.sticks[1]);

  desk.sticks[1].name = "Bad\nname";
  AxisLearner again(Control::pedal);
  desk.move(again, 1, 1, -0.7);
  desk.move(again, 1, 1, 0.9);
  desk.rest(again);
  CHECK(again.answer().stick == "0b");
  CHECK(find_stick(desk.sticks, again.answer()) == &desk.sticks[1]);
}

TEST_CASE("nonsense is refused in one sentence that says what to do") {
  const auto learn = [](Control control, const auto& person) {
    Desk desk;
    AxisLearner learner(control);
    learner.watch_move(desk.shown());
    person(desk, learner);
    return refusal(learner);
  };
  CHECK(learn(Control::pedal, [](Desk& desk, AxisLearner& learner) { desk.rest(learner); }) ==
        "nothing moved: move one control all the way, and let it go");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisLearner& learner) {
          desk.move(learner, 1, 1, -0.7);
          desk.move(learner, 1, 2, -1.0);
          desk.rest(learner);
        }) == "two axes moved together, axis 1 of Pedals and axis 2 of Pedals: move one control alone");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisLearner& learner) {
          desk.move(learner, 1, 1, -0.7);
          desk.move(learner, 1, 1, 0.1);  // held half down
          desk.rest(learner);
        }) == "axis 1 of Pedals rests in the middle of its way: press the pedal down, and let it go");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisLearner& learner) {
          desk.move(learner, 1, 1, -0.7);
          desk.move(learner, 1, 1, 0.9);
          desk.rest(learner, 5);
        }) == "axis 1 of Pedals was not seen at rest: let it go, and leave it alone for a second");
  CHECK(learn(Control::pedal, [](Desk& desk, AxisLearner& learner) {
          desk.move(learner, 1, 1, -0.7);
          desk.move(learner, 1, 1, 0.9);
          desk.noise = 0.4;
          desk.rest(learner);
        }).find("axis 1 of Pedals does not rest: left alone it was 0.2") == 0);
  CHECK(learn(Control::lever, [](Desk& desk, AxisLearner& learner) {
          desk.move(learner, 0, 0, 0.9);
          desk.move(learner, 0, 0, 0.1);
          desk.rest(learner);
        }) == "axis 0 of Stick went to one side of its rest only: move the lever to one end, then to the other");
  CHECK(learn(Control::lever, [](Desk& desk, AxisLearner& learner) {
          desk.move(learner, 0, 0, 0.9);
          desk.sticks.pop_back();
          desk.move(learner, 0, 0, -0.9);
        }) == "a stick was plugged in or out meanwhile: try again");
  AxisLearner alone(Control::pedal);
  alone.watch_move({});
  CHECK(refusal(alone) == "no stick with an axis is plugged in");
}

TEST_CASE("values that are no numbers are not learnt") {
  Desk desk;
  AxisLearner learner(Control::pedal);
  desk.move(learner, 1, 1, -0.7);
  std::vector<PadState> broken = desk.sticks;
  broken[1].axes[1] = broken[0].axes[0] = std::nanf("");
  learner.watch_move(broken);
  learner.watch_rest(broken);
  desk.move(learner, 1, 1, 0.9);
  desk.rest(learner);
  CHECK(learner.answer().from == doctest::Approx(0.9).epsilon(0.005));
}
