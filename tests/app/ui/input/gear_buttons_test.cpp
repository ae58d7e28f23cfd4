// Shifters with a button per gear or per direction move the lever through the shipped gates, beneath a simulated hand.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/ui/input/driver_input.h"
#include "app/ui/input/gear_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/shift_script.h"
#include "tests/support/controllers.h"
#include "tests/support/gates.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;
using glm::dvec2;

namespace {

constexpr double kFrameTime = 0.016;  // [s]
constexpr int kButtonOfReverse = 18;  // as on the shifter of a Logitech G29: 12 to 17 are gears 1 to 6

int button_of(int gear) {
  return gear == kReverseGear ? kButtonOfReverse : 11 + gear;
}

Bindings shifter_bindings() {
  ControllerButtons shifter{{"G29", ""}, 0, {{Action::shift_up, {4}}, {Action::shift_down, {5}}}, {}};
  shifter.gears[kReverseGear] = {kButtonOfReverse};
  for (int gear = 1; gear <= 6; ++gear) shifter.gears[gear] = {button_of(gear)};
  Bindings bindings;
  bindings.keys = {{Action::lever_left, {GLFW_KEY_LEFT}},
                   {Action::lever_back, {GLFW_KEY_DOWN}},
                   {Action::lift, {GLFW_KEY_W}},
                   {Action::clutch, {GLFW_KEY_A}}};
  bindings.controllers = {shifter};
  return bindings;
}

// A blocking synchroniser: no gear beyond this depth.
class BlockedGears final : public LeverLoad {
 public:
  bool blocks = false;
  LeverOutput step(const LeverInput& in, double) noexcept override {
    LeverOutput out;
    if (blocks && in.slot != kNoSlot) out.limited_slot = in.slot, out.depth_max = 0.010;
    return out;
  }
  const char* replay_parameters() const noexcept override { return "blocked"; }
};

class ShifterDesk {
 public:
  explicit ShifterDesk(const Gate& gate)
      : gate_(gate),
        hand_(target_, 0.001),
        lever_(gripped(), 1'000'000, hand_),
        loop_({}, gate_, lever_, load, inputs_) {
    driver.set_gate(gate_, lever_.spec());
    loop_.arm();
    input.controllers = {controller("Logitech G29", {0.0f}, 29)};
    run(0.8);
  }

  // Releases all gear buttons, then holds that of `gear`, or none for neutral. A real shifter's travel takes `between`.
  void put(int gear, double between = 0.12) {
    std::fill(buttons().begin(), buttons().end(), 0);
    run(between);
    if (gear != kNeutralGear) buttons()[static_cast<std::size_t>(button_of(gear))] = 1;
  }
  void press(std::size_t button) {
    buttons()[button] = 1;
    run(2 * kFrameTime);
    buttons()[button] = 0;
  }
  void run(double seconds) {
    for (double time = 0.0; time < seconds; time += frame_time) {
      driver.feel(loop_.snapshot().lever, loop_.snapshot().gear);
      driver.update(input, frame_time, false, false);
      input.events.clear();
      target_.write(driver.hand());
      for (int i = 0; i < std::lround(1e3 * frame_time); ++i) {
        loop_.cycle(now_ += 1'000'000, 0);
        max_push = std::max(max_push, glm::length(loop_.snapshot().f_h));
        if (loop_.snapshot().gear != kNeutralGear) gears_.insert(loop_.snapshot().gear);
      }
    }
  }
  int gear() const { return loop_.snapshot().gear; }
  double push() const { return glm::length(loop_.snapshot().f_h); }
  dvec2 at() const { return loop_.snapshot().lever; }
  std::vector<unsigned char>& buttons() { return input.controllers[0].buttons; }
  std::set<int> take_gears() { return std::exchange(gears_, {}); }

  DriverInput driver{{shifter_bindings()}};
  WindowInput input;
  BlockedGears load;
  double max_push = 0.0;           // [N]
  double frame_time = kFrameTime;  // [s] whole milliseconds

 private:
  static SimulatedLeverConfig gripped() {
    SimulatedLeverConfig config;
    config.hand = kGripHand;
    return config;
  }

  Gate gate_;
  LatestValue<HandTarget> target_;
  SmoothedHand hand_;
  SimulatedLever lever_;
  LoopInputs inputs_;
  HapticLoop loop_;
  std::int64_t now_ = 0;
  std::set<int> gears_;
};

}  // namespace

TEST_CASE("in every shipped gate a button per gear shifts from any gear to any other, reverse included") {
  for (const std::string& name : shipped_names()) {
    const Gate gate = shipped_gate(name);
    CAPTURE(name);
    ShifterDesk desk(gate);
    const std::vector<int> gears = tour_order(gate);
    for (const int from : gears)
      for (const int to : gears) {
        if (from == to || std::max(from, to) > 6) continue;
        CAPTURE(from);
        CAPTURE(to);
        desk.put(from);
        desk.run(1.0);
        CHECK(desk.gear() == from);
        desk.take_gears();
        desk.put(to);
        desk.run(1.5);  // a stiff spring in front of R slows the hand
        CHECK(desk.gear() == to);
        CHECK_FALSE(desk.driver.missed_gear());
        std::set<int> passed = desk.take_gears();
        passed.erase(from);
        CHECK(passed == std::set<int>{to});  // no other gear on the way
        CHECK(desk.push() < 1.0);            // the hand does not lean on the gear
      }
    desk.put(kNeutralGear);
    desk.run(1.5);
    CHECK(desk.gear() == kNeutralGear);
    CHECK(glm::length(desk.at() - rest_position(gate, kNeutralGear)) < 0.003);
    MESSAGE(name, ": largest push ", desk.max_push, " N");
    CHECK(desk.max_push < 60.0);  // below the warning of an over-push
  }
}

TEST_CASE("at 5 to 144 frames per second the lever takes no other gear on its way") {
  for (const double frame_time : {0.007, 0.1, 0.2}) {
    const Gate gate = shipped_gate("five_speed_r_right_down");
    ShifterDesk desk(gate);
    desk.frame_time = frame_time;
    for (const int gear : {1, kReverseGear, 1, 4, kReverseGear, 3, 2, 5, kNeutralGear, 1}) {
      CAPTURE(frame_time);
      CAPTURE(gear);
      desk.take_gears();
      const int before = desk.gear();
      desk.put(gear);
      desk.run(3.0);
      CHECK(desk.gear() == gear);
      std::set<int> passed = desk.take_gears();
      passed.erase(before);
      passed.erase(gear);
      CHECK(passed.empty());
    }
  }
}

TEST_CASE("the hand stops at every corner of its way, also where a frame is longer than a stroke") {
  const Gate gate = shipped_gate("six_speed_r_left_up");
  for (const int to : {6, kReverseGear, kNeutralGear}) {
    GearHand hand;
    hand.set_gate(gate);
    const dvec2 start = rest_position(gate, 1), end = rest_position(gate, to);
    hand.shift_to(to, 1, start);
    std::vector<dvec2> way{start};
    for (int i = 0; i < 20; ++i) way.push_back(hand.next(1.5, way.back(), kNeutralGear).position);
    // Between two frames, the lever moves in a straight line: along the slot, along the aisle, along the other slot.
    for (std::size_t i = 1; i < way.size(); ++i) {
      CAPTURE(to);
      CAPTURE(i);
      const dvec2 moved = glm::abs(way[i] - way[i - 1]);
      CHECK(std::min(moved.x, moved.y) < 1e-3);
    }
    CHECK(glm::distance(way.back(), end) < 1e-3);
  }
}

TEST_CASE("a shifter that is in neutral from the start does not pull the lever back from where keys have moved it") {
  ShifterDesk desk(paper_gate());
  desk.input.events = {KeyEvent{GLFW_KEY_LEFT, true, false, false, false}};
  desk.run(0.1);
  CHECK(desk.at().x < -0.003);  // keys move the lever, and the silent shifter does not pull it back
  desk.run(0.5);
  const dvec2 held = desk.at();
  desk.run(0.5);
  CHECK(glm::length(desk.at() - held) < 0.002);
}

TEST_CASE("buttons per direction shift one gear: R N 1 2 3 and back; beyond the last gear nothing moves") {
  ShifterDesk desk(paper_gate());
  std::vector<int> reached;
  const auto press = [&](std::size_t button) {
    desk.press(button);
    desk.run(1.0);
    reached.push_back(desk.gear());
  };
  for (int i = 0; i < 6; ++i) press(4);
  for (int i = 0; i < 8; ++i) press(5);
  CHECK(reached == std::vector{1, 2, 3, 4, 5, 5, 4, 3, 2, 1, kNeutralGear, kReverseGear, kReverseGear, kReverseGear});
}

TEST_CASE("a gear that the gate lacks or that is blocked is reported as missed; pressing the clutch tries again") {
  ShifterDesk desk(paper_gate());
  desk.put(6);
  desk.run(2.0);
  CHECK(desk.gear() == kNeutralGear);
  REQUIRE(desk.driver.missed_gear());
  CHECK(desk.driver.missed_gear()->gear == 6);
  desk.load.blocks = true;
  desk.put(3);
  desk.run(2.5);
  CHECK(desk.gear() == kNeutralGear);
  REQUIRE(desk.driver.missed_gear());
  CHECK(desk.driver.missed_gear()->gear == 3);
  CHECK(desk.driver.missed_gear()->of_shifter);
  CHECK(desk.push() < 1.0);  // the hand has given up
  desk.load.blocks = false;
  desk.run(0.5);
  CHECK(desk.gear() == kNeutralGear);
  desk.input.events = {KeyEvent{GLFW_KEY_A, true, false, false, false}};  // clutch
  desk.run(1.0);
  CHECK(desk.gear() == 3);
  CHECK_FALSE(desk.driver.missed_gear());
}

TEST_CASE(
    "a button that is down when its controller appears, or when bindings change, does nothing before its release") {
  Bindings bindings;
  bindings.controllers = {{{"Box", ""}, 0, {{Action::arm, {0}}, {Action::shift_down, {1}}}, {}}};
  bindings.pad_buttons = {{Action::quit, {2}}};
  DriverInput driver({bindings});
  WindowInput input;
  input.controllers = {controller("Box", {}, 2), gamepad({}, {0, 0, 1})};
  const auto pressed = [&] {
    driver.update(input, kFrameTime, false, false);
    return driver.pressed();
  };
  using Actions = std::vector<Action>;
  input.controllers[0].buttons = {1, 1};
  CHECK(pressed() == Actions{});
  CHECK(pressed() == Actions{});
  driver.rebind(bindings);
  CHECK(pressed() == Actions{});
  const std::vector<Controller> unplugged = std::exchange(input.controllers, {});
  CHECK(pressed() == Actions{});
  input.controllers = unplugged;
  CHECK(pressed() == Actions{});
  input.controllers[0].buttons = {0, 0};
  input.controllers[1].gamepad->buttons[2] = 0;
  CHECK(pressed() == Actions{});
  input.controllers[0].buttons = {1, 0};
  input.controllers[1].gamepad->buttons[2] = 1;
  CHECK(pressed() == Actions{Action::quit, Action::arm});
}

TEST_CASE("keys take the hand over from a shifter, whose next gear takes it back; an unplugged one does not move it") {
  ShifterDesk desk(paper_gate());
  desk.put(3);
  desk.run(1.0);
  CHECK(desk.gear() == 3);
  std::vector<Controller> unplugged = std::exchange(desk.input.controllers, {});
  desk.run(1.0);
  CHECK(desk.gear() == 3);
  desk.input.controllers = unplugged;
  desk.put(2, 0.0);  // plugged in again, in another gear: nothing moves before the shifter is moved
  desk.run(1.0);
  CHECK(desk.gear() == 3);
  REQUIRE(desk.driver.missed_gear());
  CHECK(desk.driver.missed_gear()->gear == 2);
  desk.put(4);
  desk.run(1.0);
  CHECK(desk.gear() == 4);
}

TEST_CASE("a lever that stays in place does not lean on the gear: at its own end the hand aims at the gear's rest") {
  Bindings bindings;
  bindings.lever.mode = LeverMode::places;
  bindings.lever_select = AxisBinding{.of = {"Shifter", ""}, .axis = 0};
  bindings.lever_shift = AxisBinding{.of = {"Shifter", ""}, .axis = 1};
  ShifterDesk desk(paper_gate());
  desk.driver.rebind(bindings);
  desk.input.controllers = {controller("Analog Shifter", {0.01f, 0.01f})};
  std::vector<float>& axes = desk.input.controllers[0].axes;
  desk.run(2 * kFrameTime);
  axes = {0.02f, 0.05f};
  desk.run(0.2);
  for (float y = 0.05f; y < 1.0f; y += 0.02f) {  // about 0.8 s to the lever's end
    axes[1] = y;
    desk.run(kFrameTime);
  }
  desk.run(0.5);
  CHECK(desk.gear() == 3);
  CHECK(desk.push() < 1.0);
  axes[1] = 0.0f;  // pulled out again
  desk.run(0.5);
  CHECK(desk.gear() == kNeutralGear);
}

// Analog axes of a shifter: 0 sideways, 1 forward and back.
Bindings axis_bindings(LeverMode mode) {
  Bindings bindings = shifter_bindings();
  bindings.controllers.clear();
  bindings.lever.mode = mode;
  bindings.lever_shift = AxisBinding{.of = {"Shifter", ""}, .axis = 1};
  return bindings;
}

WindowInput key(int code, bool down) {
  WindowInput input;
  input.events = {KeyEvent{code, down, false, false, false}};
  return input;
}

TEST_CASE("a sequential gate: paddles shift one gear each; neutral and reverse need the lift ring on the way down") {
  ShifterDesk desk(shipped_gate(kSequentialGate));
  std::vector<int> reached;
  const auto press = [&](std::size_t button) {
    desk.press(button);
    desk.run(4.0);
    reached.push_back(desk.gear());
  };
  for (int i = 0; i < 7; ++i) press(4);
  for (int i = 0; i < 6; ++i) press(5);
  CHECK(reached == std::vector{1, 2, 3, 4, 5, 6, 6, 5, 4, 3, 2, 1, 1});
  REQUIRE(desk.driver.missed_gear());
  CHECK(desk.driver.missed_gear()->gear == kNeutralGear);
  CHECK(desk.push() < 1.0);  // the hand has given up, and the lever has sprung back
  CHECK(glm::length(desk.at()) < 0.003);
  desk.input.events = key(GLFW_KEY_A, true).events;  // the clutch opens no lockout
  desk.run(0.4);
  CHECK(desk.push() < 1.0);
  CHECK(glm::length(desk.at()) < 0.003);
  desk.input.events = key(GLFW_KEY_W, true).events;
  reached.clear();
  for (int i = 0; i < 3; ++i) press(5);
  desk.input.events = key(GLFW_KEY_W, false).events;
  for (int i = 0; i < 2; ++i) press(4);
  CHECK(reached == std::vector{kNeutralGear, kReverseGear, kReverseGear, kNeutralGear, 1});
  CHECK_FALSE(desk.driver.missed_gear());
  MESSAGE("largest push ", desk.max_push, " N");
  CHECK(desk.max_push < 60.0);
}

TEST_CASE("a sequential gate: paddles pressed faster than the lever moves lose no gear") {
  ShifterDesk desk(shipped_gate(kSequentialGate));
  for (int i = 0; i < 4; ++i) {
    desk.press(4);
    desk.run(0.1);
  }
  desk.run(5.0);
  CHECK(desk.gear() == 4);
  for (int i = 0; i < 3; ++i) {
    desk.press(5);
    desk.run(0.1);
  }
  desk.run(5.0);
  CHECK(desk.gear() == 1);
}

TEST_CASE("a sequential gate: a shifter with a button per gear goes there in as many strokes as needed") {
  ShifterDesk desk(shipped_gate(kSequentialGate));
  for (const int gear : {1, 4, 2, 6, kReverseGear, 3}) {
    CAPTURE(gear);
    desk.put(gear);
    desk.run(6.0);
    CHECK(desk.gear() == gear);
    CHECK_FALSE(desk.driver.missed_gear());
  }
  desk.put(kNeutralGear);
  desk.run(4.0);
  CHECK(desk.gear() == kNeutralGear);
}

TEST_CASE("a sprung lever with axes shifts gears in steps, in a sequential gate and in an H gate") {
  for (const char* name : {kSequentialGate, "paper"}) {
    CAPTURE(name);
    ShifterDesk desk(shipped_gate(name));
    desk.driver.rebind(axis_bindings(LeverMode::steps));
    desk.input.controllers = {controller("Sequential Shifter", {0.0f, 0.01f})};
    float& shift = desk.input.controllers[0].axes[1];
    const auto pull = [&](float to) {
      for (const float at :
           {0.3f * to, 0.7f * to, to, 0.65f * to, to, 0.5f * to, 0.0f}) {  // trembles about the threshold
        shift = at;
        desk.run(2 * kFrameTime);
      }
      desk.run(1.5);
      return desk.gear();
    };
    shift = 0.05f;  // the first report
    desk.run(2 * kFrameTime);
    CHECK(pull(-1.0f) == 1);
    CHECK(pull(-0.8f) == 2);
    CHECK(pull(-0.5f) == 2);
    CHECK(pull(-1.0f) == 3);
    CHECK(pull(1.0f) == 2);
    shift = -1.0f;  // held: one gear
    desk.run(4.0);
    CHECK(desk.gear() == 3);
  }
}

TEST_CASE(
    "a sequential gate: a lever with axes that places the hand shifts one gear per stroke, and leans on nothing") {
  ShifterDesk desk(shipped_gate(kSequentialGate));
  desk.driver.rebind(axis_bindings(LeverMode::places));
  desk.input.controllers = {controller("Sequential Shifter", {0.0f, 0.01f})};
  float& shift = desk.input.controllers[0].axes[1];
  const auto stroke = [&](float to) {
    for (int i = 1; i <= 20; ++i) {
      shift = to * static_cast<float>(i) / 20.0f;
      desk.run(kFrameTime);
    }
    desk.run(0.3);
    shift = 0.0f;
    desk.run(1.0);
    return desk.gear();
  };
  shift = 0.05f;
  desk.run(2 * kFrameTime);
  CHECK(stroke(-1.0f) == 1);
  CHECK(stroke(-1.0f) == 2);
  CHECK(stroke(1.0f) == 1);
  CHECK(stroke(1.0f) == 1);  // neutral is locked out
  CHECK(desk.push() < 1.0);
  CHECK(glm::length(desk.at()) < 0.003);
}

TEST_CASE("a sequential gate: a lever that a key has pulled springs back when the key is released") {
  ShifterDesk desk(shipped_gate(kSequentialGate));
  desk.input.events = key(GLFW_KEY_DOWN, true).events;
  desk.run(0.6);
  CHECK(desk.gear() == 1);
  CHECK(desk.at().y < -0.030);
  desk.input.events = key(GLFW_KEY_DOWN, false).events;
  desk.run(0.6);
  CHECK(glm::length(desk.at()) < 0.003);
  CHECK(desk.push() < 1.0);
  CHECK(desk.gear() == 1);
}
