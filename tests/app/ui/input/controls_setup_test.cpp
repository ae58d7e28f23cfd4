// Setting up pedals, levers and shifters. A simulated user moves what the prompt asks for.
#include "app/ui/input/controls_setup.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include <doctest/doctest.h>

#include "app/ui/input/controls_dialog.h"
#include "tests/support/controllers.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

using Answer = ControlsSetup::Answer;

bool has(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

// A user with a Logitech G29 (three pedals, 1 released and -1 pressed; gears 1 to 6 on buttons 12 to 17, reverse on 18;
// paddles 4 and 5), an analog lever and a handbrake that is a button. Its first report moves all pedals.
struct Person {
  explicit Person(Bindings start = {})
      : setup(std::move(start), read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml"), gears_to_set_up()) {
    devices[0].buttons[22] = 1;  // a rotary switch that is always on
    frame(5);
    devices[0].axes = {0.0f, 1.0f, 1.0f, 1.0f};  // the first report
    frame(5);
  }
  void frame(int count = 1) {
    for (int i = 0; i < count; ++i) setup.frame(devices, 0.01);
  }
  void move(float& axis, float to) {
    const float from = axis;
    for (int i = 1; i <= 30; ++i) {
      axis = from + static_cast<float>(i) / 30.0f * (to - from);
      frame();
    }
  }
  void pedal(std::size_t axis) {
    move(devices[0].axes[axis], -1.0f);
    move(devices[0].axes[axis], 1.0f);
  }
  void lever(std::size_t axis) {
    float& value = devices[1].axes[axis];
    move(value, -0.9f);
    move(value, 0.8f);
    move(value, 0.0f);
  }
  void press(std::size_t device, std::size_t button) {
    devices[device].buttons[button] = 1;
    frame(5);
    devices[device].buttons[button] = 0;
    frame(5);
  }
  void hold(int button) {  // of the shifter; -1: neutral
    for (std::size_t i = 12; i <= 19; ++i) devices[0].buttons[i] = 0;
    if (button >= 0) devices[0].buttons[static_cast<std::size_t>(button)] = 1;
    frame(5);
  }
  void say(Answer answer) {
    setup.answer(answer);
    for (int i = 0; setup.is_resting() && i < 1000; ++i) frame();
  }
  // Goes through the steps; `does` moves what a prompt asks for and returns the answer.
  void go_through(const std::function<Answer(const std::string&)>& does, int most = 40) {
    for (int i = 0; i < most && !setup.is_over(); ++i) say(does(setup.prompt()));
  }

  std::vector<Controller> devices{controller("Logitech G29", {0.0f, -1.0f, -1.0f, -1.0f}, 25, "046d:c24f"),
                                  controller("Shifter", {0.0f, 0.0f}, 0, "s"), controller("Box", {}, 4, "b"),
                                  gamepad({})};
  ControlsSetup setup;
};

Answer does_pedals(Person& person, const std::string& prompt) {
  if (has(prompt, "CLUTCH")) person.pedal(1);
  if (has(prompt, "THROTTLE")) person.pedal(2);
  if (has(prompt, "BRAKE pedal")) person.pedal(3);
  if (has(prompt, "HANDBRAKE")) person.press(2, 1);
  if (has(prompt, "What does the button")) return Answer::held;
  return Answer::done;
}

}  // namespace

TEST_CASE("a wheel with a shifter is set up: each pedal, a handbrake button and every gear that the shifter has") {
  Person person;
  person.go_through([&](const std::string& prompt) {
    if (has(prompt, "How do you shift")) return Answer::gear_buttons;
    if (has(prompt, "NEUTRAL")) person.hold(-1);
    for (int gear = 1; gear <= 6; ++gear)
      if (has(prompt, ("gear " + std::to_string(gear) + " and").c_str())) person.hold(11 + gear);
    if (has(prompt, "REVERSE")) person.hold(18);
    return does_pedals(person, prompt);
  });
  REQUIRE(person.setup.is_over());
  const Bindings& bindings = person.setup.bindings();
  REQUIRE((bindings.clutch && bindings.brake && bindings.throttle));
  CHECK(bindings.clutch->of == ControllerName{"Logitech G29", "046d:c24f"});
  CHECK(bindings.clutch->axis == 1);
  CHECK(bindings.throttle->axis == 2);
  CHECK(bindings.brake->axis == 3);
  CHECK(pedal_value(*bindings.clutch, 1.0) == 0.0);
  CHECK(pedal_value(*bindings.clutch, -1.0) == 1.0);
  CHECK_FALSE(bindings.hand_brake);
  REQUIRE(bindings.controllers.size() == 2);
  CHECK(bindings.controllers[0].of.stick == "Box");
  CHECK(bindings.controllers[0].actions.at(Action::hand_brake_hold) == std::vector{1});
  CHECK(bindings.controllers[1].gears ==
        std::map<int, std::vector<int>>{
            {kReverseGear, {18}}, {1, {12}}, {2, {13}}, {3, {14}}, {4, {15}}, {5, {16}}, {6, {17}}});
}

TEST_CASE("a button that is held in neutral and released in a gear is neutral's; paddles and a lever are set up, too") {
  Person with_neutral;
  with_neutral.go_through([&](const std::string& prompt) {
    if (has(prompt, "How do you shift")) return Answer::gear_buttons;
    if (has(prompt, "NEUTRAL")) return with_neutral.hold(19), Answer::done;
    if (has(prompt, "gear 1 ")) return with_neutral.hold(12), Answer::done;
    return Answer::skip;
  });
  CHECK(with_neutral.setup.bindings().controllers.at(0).gears ==
        std::map<int, std::vector<int>>{{kNeutralGear, {19}}, {1, {12}}});

  Person paddles(with_neutral.setup.bindings());  // the other way of shifting replaces the first
  paddles.go_through([&](const std::string& prompt) {
    if (has(prompt, "How do you shift")) return Answer::two_buttons;
    if (has(prompt, "Shift UP")) return paddles.press(0, 4), Answer::done;
    if (has(prompt, "Shift DOWN")) return paddles.press(0, 5), Answer::done;
    return Answer::skip;
  });
  const ControllerButtons& wheel = paddles.setup.bindings().controllers.at(0);
  CHECK(wheel.gears.empty());
  CHECK(wheel.actions == std::map<Action, std::vector<int>>{{Action::shift_up, {4}}, {Action::shift_down, {5}}});

  Person lever;
  lever.go_through([&](const std::string& prompt) {
    if (has(prompt, "How do you shift")) return Answer::lever;
    if (has(prompt, "left")) return lever.lever(0), Answer::done;
    if (has(prompt, "forward")) return lever.lever(1), Answer::done;
    return has(prompt, "stay in place") ? Answer::stays : Answer::skip;
  });
  CHECK(lever_value(*lever.setup.bindings().lever_select, -0.9) == -1.0);
  CHECK(lever.setup.bindings().lever_shift->axis == 1);
  CHECK(lever.setup.bindings().lever.mode == LeverMode::places);

  Person sprung;  // a sequential lever with an axis
  sprung.go_through([&](const std::string& prompt) {
    if (has(prompt, "How do you shift")) return Answer::lever;
    if (has(prompt, "forward")) return sprung.lever(1), Answer::done;
    return has(prompt, "stay in place") ? Answer::steps : Answer::skip;
  });
  CHECK(sprung.setup.bindings().lever_shift->axis == 1);
  CHECK(sprung.setup.bindings().lever.mode == LeverMode::steps);
  CHECK(bindings_text(sprung.setup.bindings()).find("mode = \"steps\"") != std::string::npos);
  CHECK(help_text(sprung.setup.bindings(), {}).find("axis 1\tback: one gear up, forward: one gear down\n") !=
        std::string::npos);
}

TEST_CASE(
    "a step is asked again with its reason until something fits; skipping keeps the binding; back takes it back") {
  Bindings start;
  start.brake = AxisBinding{.of = {"another", ""}};
  Person person(start);
  person.say(Answer::done);
  CHECK(person.setup.note() == "Nothing moved. Move one control all the way and release it. Try again.");
  CHECK(has(person.setup.prompt(), "CLUTCH"));
  person.pedal(1);
  person.say(Answer::done);
  CHECK(person.setup.note() == "Found: axis 1 of Logitech G29, from 1.00 to -1.00.");
  person.say(Answer::skip);  // the brake
  CHECK(person.setup.bindings().brake->of.stick == "another");
  person.say(Answer::back);
  person.say(Answer::back);
  CHECK(has(person.setup.prompt(), "CLUTCH"));
  CHECK_FALSE(person.setup.bindings().clutch);
  for (int i = 0; i < 4; ++i) person.say(Answer::skip);
  person.say(Answer::gear_buttons);
  person.say(Answer::done);  // neutral
  person.say(Answer::done);  // no gear is held
  CHECK(person.setup.note() == "No button of a shifter is held in this gear. Try again.");
  person.hold(12);
  person.say(Answer::done);
  person.say(Answer::done);  // gear 2, but the shifter is still in gear 1
  CHECK(person.setup.note() == "This button is bound already (gear 1). Try again.");
  person.devices[0].buttons[13] = 1;
  person.frame(5);
  person.say(Answer::done);
  CHECK(person.setup.note() == "Several buttons are held. Touch only the shifter. Try again.");
}

TEST_CASE("game pads are not set up, except the encoder that is built into pads and shifters alike") {
  Controller encoder = gamepad({});
  encoder.id = "0079:0006";
  Controller closed = controller("Pedals", {});
  closed.can_be_read = false;
  CHECK(controllers_to_set_up({gamepad({}), closed}).empty());
  CHECK(controllers_to_set_up({gamepad({}), encoder, controller("Wheel", {})}).size() == 2);
}

TEST_CASE("at 4 frames per second a released pedal is measured in enough frames") {
  Person person;
  person.pedal(1);
  person.setup.answer(Answer::done);
  int frames = 0;
  while (person.setup.is_resting() && ++frames < 100) person.setup.frame(person.devices, 0.25);
  CHECK(frames == AxisDetector::kMinRestFrames);
  CHECK(person.setup.bindings().clutch);
}

TEST_CASE("starting over begins with the shipped bindings, and does not change the saved ones") {
  const TempFolder folder;
  const std::filesystem::path own = folder / "own.toml", defaults = GEARSHIFT_ASSETS "/bindings/default.toml";
  CHECK(bindings_text(starting_bindings(own, defaults, false)) == bindings_text(read_bindings(defaults)));
  Bindings saved = read_bindings(defaults);
  saved.clutch = AxisBinding{.of = {"Pedals", ""}};
  save_bindings(saved, own);
  CHECK(starting_bindings(own, defaults, false).clutch->of.stick == "Pedals");
  CHECK_FALSE(starting_bindings(own, defaults, true).clutch);
  CHECK(read_bindings(own).clutch->of.stick == "Pedals");
}

TEST_CASE("an axis that is bound to another control in this run is refused; an older binding of it ends") {
  Bindings start;
  start.brake = AxisBinding{.of = {"Logitech G29", ""}, .axis = 1, .from = 1.0, .to = -1.0};
  Person person(start);
  person.pedal(1);
  person.say(Answer::done);  // the clutch
  CHECK(person.setup.bindings().clutch);
  CHECK_FALSE(person.setup.bindings().brake);
  person.pedal(1);
  person.say(Answer::done);  // the brake
  CHECK(person.setup.note() == "This axis is bound to another control already (clutch). Try again.");
}

TEST_CASE("each way of shifting replaces the others, and gives a game pad its lever back") {
  Bindings start;
  start.lever.mode = LeverMode::places;
  start.lever_select = AxisBinding{.of = {"Old lever", ""}};
  start.controllers = {{{"Old Shifter", ""}, 0, {{Action::shift_up, {1}}}, {{1, {0}}}}};
  Person person(start);
  person.go_through(
      [&](const std::string& prompt) { return has(prompt, "How do you shift") ? Answer::other : Answer::skip; });
  const Bindings& bindings = person.setup.bindings();
  CHECK(bindings.lever_select->of.stick.empty());
  CHECK(bindings.lever.mode == LeverMode::moves);
  CHECK(bindings.controllers.empty());  // it has no button left, so it is not missed when it is unplugged
}

TEST_CASE("two equal devices keep their own buttons; one kind of handbrake replaces the other") {
  Bindings start;
  start.hand_brake = AxisBinding{.of = {"Old handbrake", ""}};
  Person person(start);
  person.devices.push_back(controller("Box", {}, 4, "b"));
  person.setup = ControlsSetup(start, {}, gears_to_set_up());
  person.frame(5);
  person.go_through([&](const std::string& prompt) {
    if (has(prompt, "HANDBRAKE")) return person.press(4, 0), Answer::done;
    if (has(prompt, "What does the button")) {
      CHECK(person.setup.note() == "Found: button 0 of Box, number 2 of 2 in the order of their ports.");
      return Answer::held;
    }
    if (has(prompt, "How do you shift")) return Answer::gear_buttons;
    if (has(prompt, "NEUTRAL")) return Answer::done;
    if (!has(prompt, "gear 1 ")) return Answer::skip;
    person.devices[2].buttons[0] = 1;
    person.frame(5);
    return Answer::done;
  });
  const std::vector<ControllerButtons>& boxes = person.setup.bindings().controllers;
  CHECK_FALSE(person.setup.bindings().hand_brake);
  REQUIRE(boxes.size() == 2);
  CHECK(boxes[0].which == 1);
  CHECK(boxes[0].actions.at(Action::hand_brake_hold) == std::vector{0});
  CHECK(boxes[1].which == 0);
  CHECK(boxes[1].gears.at(1) == std::vector{0});
}

TEST_CASE("for the picture, a control's rest is where its first report was, not what the kernel held before") {
  AxisDetector detector(AxisDetector::Control::pedal);
  std::vector<Controller> all{controller("Wheel", {-1.0f})};
  detector.record_move(all);
  for (const float raw : {1.0f, 0.5f, -0.5f}) {
    all[0].axes[0] = raw;
    detector.record_move(all);
  }
  REQUIRE(detector.moving());
  CHECK(detector.moving()->rest == 1.0);
}

TEST_CASE(
    "before and after skipping, the consequence is said: with what the control still works, or that it does not") {
  Bindings start = read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml");
  start.clutch = AxisBinding{.of = {"Old pedals", ""}, .axis = 2};
  start.pad_buttons.clear();
  Person person(start);
  const auto skip = [&] {
    const std::string consequence = person.setup.if_skipped();
    person.say(Answer::skip);
    CHECK(person.setup.note() == "Skipped: " + consequence + ".");
    return consequence;
  };
  CHECK(skip() == "you still use the clutch with Old pedals axis 2, A");
  CHECK(skip() == "you still use the brake with Pad LT, S");
  CHECK(skip() == "you still use the throttle with Pad RT, D, X, V");
  CHECK(skip() == "you still use the handbrake with B, H");
  CHECK(person.setup.if_skipped().empty());  // the way of shifting has to be chosen
  person.say(Answer::lever);
  CHECK(skip() == "you still move the lever sideways with Pad right stick, left and right, Left, Right, the mouse");
  person.say(Answer::back);
  person.say(Answer::back);
  person.say(Answer::two_buttons);
  CHECK(skip() == "you still shift one gear up with Page Up");

  Person bare;  // nothing is bound
  CHECK(bare.setup.if_skipped() == "you cannot use the clutch until something is bound to it");
  for (int i = 0; i < 4; ++i) bare.say(Answer::skip);
  bare.say(Answer::gear_buttons);
  bare.say(Answer::done);
  CHECK(bare.setup.if_skipped() == "in gear 1 the shifter counts as in neutral");
}

TEST_CASE("a shifter is asked for the gears of the gate; set up again, it keeps the gears that are skipped") {
  for (const std::string& name : shipped_names()) {
    if (name == "seven_speed") continue;  // no shipped car has seven gears
    const std::vector<int> gears = gears_to_set_up(shipped_gate(name)), all = gears_to_set_up();
    CHECK(gears.back() == kReverseGear);
    CHECK(std::includes(all.rbegin(), all.rend(), gears.rbegin(), gears.rend(), std::greater<>()));
  }
  CHECK(gears_to_set_up(shipped_gate("four_speed")) == std::vector{1, 2, 3, 4, kReverseGear});

  Person person;
  const auto answers = [&](const std::vector<int>& gears) {
    return [&person, gears](const std::string& prompt) {
      if (has(prompt, "How do you shift")) return Answer::gear_buttons;
      if (has(prompt, "NEUTRAL")) return person.hold(-1), Answer::done;
      for (const int gear : gears)
        if (has(prompt, ("gear " + std::to_string(gear) + " and").c_str())) return person.hold(11 + gear), Answer::done;
      return Answer::skip;
    };
  };
  const auto start = [&](const std::string& gate) {
    person.setup = ControlsSetup(person.setup.bindings(), {}, gears_to_set_up(shipped_gate(gate)));
    person.frame(5);
  };
  start("four_speed");
  person.go_through(answers({1, 2, 3, 4}));
  CHECK(has(person.setup.note(), "For a car with more gears, choose it and set up again: Skip keeps what is bound."));
  start("six_speed_r_left_up");
  person.go_through(answers({5, 6}));
  CHECK_FALSE(has(person.setup.note(), "more gears"));
  using Gears = std::map<int, std::vector<int>>;
  CHECK(person.setup.bindings().controllers.at(0).gears ==
        Gears{{1, {12}}, {2, {13}}, {3, {14}}, {4, {15}}, {5, {16}}, {6, {17}}});
  // A skipped gear keeps its button; one that is not asked gives it up.
  start("four_speed");
  person.go_through([&](const std::string& prompt) {
    if (!has(prompt, "gear 2 ")) return answers({})(prompt);
    person.hold(12);
    if (has(person.setup.note(), "Skipped")) return Answer::done;
    CHECK(person.setup.note() == "This button is bound already (gear 1). Try again.");
    person.hold(17);
    return Answer::done;
  });
  CHECK(person.setup.bindings().controllers.at(0).gears ==
        Gears{{1, {12}}, {2, {17}}, {3, {14}}, {4, {15}}, {5, {16}}});
  // The gears of a shifter that is not plugged in are forgotten.
  person.devices.erase(person.devices.begin());
  start("four_speed");
  person.go_through([&](const std::string& prompt) {
    return has(prompt, "How do you shift") ? Answer::gear_buttons
           : has(prompt, "NEUTRAL")        ? Answer::done
                                           : Answer::skip;
  });
  CHECK(person.setup.bindings().controllers.empty());
}

TEST_CASE("a handbrake button is on while it is down, or switches at each press; no other control may take it") {
  for (const Answer answer : {Answer::held, Answer::toggled}) {
    Bindings start;
    start.controllers = {{{"Box", ""}, 0, {{Action::hand_brake_hold, {0}}, {Action::hand_brake, {3}}}, {}}};
    Person person(start);
    for (int i = 0; i < 3; ++i) person.say(Answer::skip);
    person.press(2, 1);
    person.say(Answer::done);
    CHECK(person.setup.choices().front().answer == Answer::held);
    person.say(answer);
    const auto& actions = person.setup.bindings().controllers.at(0).actions;
    const Action bound = answer == Answer::held ? Action::hand_brake_hold : Action::hand_brake;
    CHECK(actions == std::map<Action, std::vector<int>>{{bound, {1}}});
    person.say(Answer::two_buttons);
    person.press(2, 1);
    person.say(Answer::done);
    CHECK(person.setup.note() == "This button is bound already (handbrake). Try again.");
    person.press(2, 2);
    person.say(Answer::done);
    person.press(2, 2);
    person.say(Answer::done);
    CHECK(person.setup.note() == "This button is bound already (one gear up). Try again.");
    // Back to the handbrake, which is an axis now: its button is not asked about.
    for (int i = 0; i < 4; ++i) person.say(Answer::back);
    CHECK(has(person.setup.prompt(), "HANDBRAKE"));
    person.pedal(1);
    person.say(Answer::done);
    CHECK(has(person.setup.prompt(), "How do you shift"));
    CHECK(person.setup.bindings().controllers.at(0).actions.empty());
  }
}
