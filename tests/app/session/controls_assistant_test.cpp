// Setting up controllers in the window: what is offered, what drives meanwhile, and what is saved.
#include "app/session/controls_assistant.h"

#include <fstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>

#include "app/ui/input/bound_controllers.h"
#include "tests/support/controllers.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

const Bindings& shipped_bindings() {
  static const Bindings bindings = read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml");
  return bindings;
}

struct ControlsDesk {
  explicit ControlsDesk(const std::filesystem::path& own_file, const std::filesystem::path& declined_file = {})
      : assistant(driver, own_file, declined_file, shipped_bindings()) {}

  void frame() {
    assistant.update(all, 0.01);
    WindowInput input;
    input.controllers = all;
    input.events.assign(keys.begin(), keys.end());
    keys.clear();
    if (assistant.is_setting_up()) message = assistant.take(input, driver.mouse_moves_lever());
    driver.update(input, 0.01, false, false);
  }
  void press_clutch() {
    for (int i = -20; i <= 20; ++i) {
      all[0].axes[1] = static_cast<float>(std::abs(i)) / 10.0f - 1.0f;
      frame();
    }
  }
  std::string enter() {
    std::string news;
    CHECK(assistant.press_enter(news));
    for (int i = 0; i < 200; ++i) frame();
    return news;
  }
  void press(int key) {
    keys = {{key, true, false, false, false}};
    frame();
    keys = {{key, false, false, false, false}};
    frame();
  }
  std::string apply(const ControlsCommand& command) { return assistant.apply(command, paper_gate()); }
  using Names = std::vector<std::string>;
  Names offers() {
    const auto offered = assistant.view(paper_gate(), true).offers;
    return {offered.begin(), offered.end()};
  }

  std::vector<Controller> all{controller("Logitech G29", {0.0f, 1.0f}, 25, "046d:c24f"), controller("Box", {}, 4),
                              gamepad({})};
  DriverInput driver{{shipped_bindings()}};
  std::vector<KeyEvent> keys;
  std::string message;
  ControlsAssistant assistant;
};

// True if the driver does not get the controllers that can be set up.
bool hides(ControlsDesk& desk) {
  WindowInput input;
  input.controllers = desk.all;
  (void)desk.assistant.take(input, true);
  return input.controllers.size() == 1;
}

}  // namespace

TEST_CASE("a wheel is set up and saved: meanwhile it does not drive, at the end it can be tried, then it works") {
  const TempFolder folder;
  ControlsDesk desk(folder / "bindings" / "own.toml");
  desk.frame();
  CHECK(desk.offers() == ControlsDesk::Names{"Logitech G29", "Box"});
  CHECK(desk.apply(StartControls{}).empty());
  CHECK(hides(desk));
  CHECK(desk.assistant.view(paper_gate(), true).setup != nullptr);
  for (int i = 0; i < 5; ++i) desk.frame();
  desk.press_clutch();
  CHECK(desk.enter().empty());
  CHECK(desk.driver.controls().pedals.clutch == 0.0);
  for (int i = 0; i < 3; ++i) (void)desk.apply(AnswerControls{ControlsSetup::Answer::skip});
  (void)desk.apply(AnswerControls{ControlsSetup::Answer::other});
  desk.frame();
  CHECK_FALSE(hides(desk));
  desk.all[0].axes[1] = 0.5f;
  desk.frame();
  desk.all[0].axes[1] = -1.0f;
  desk.frame();
  CHECK(desk.driver.controls().pedals.clutch == 1.0);
  CHECK(desk.enter() == "Saved: " + (folder / "bindings" / "own.toml").string());
  CHECK(read_bindings(folder / "bindings" / "own.toml").clutch->of.stick == "Logitech G29");
  CHECK_FALSE(desk.assistant.press_enter(desk.message));
  CHECK(desk.offers() == ControlsDesk::Names{"Box"});
}

TEST_CASE("after cancelling the old bindings apply; a declined controller is not offered again") {
  const TempFolder folder;
  ControlsDesk desk(folder / "own.toml");
  desk.frame();
  (void)desk.apply(StartControls{});
  desk.frame();
  desk.press_clutch();
  desk.enter();
  (void)desk.apply(CancelControls{});
  CHECK_FALSE(desk.driver.bindings().clutch);
  CHECK_FALSE(std::filesystem::exists(folder / "own.toml"));
  (void)desk.apply(DeclineControls{});
  desk.frame();
  CHECK(desk.offers().empty());
  desk.all.push_back(controller("Pedals", {0.0f}));  // another one, plugged in later
  desk.frame();
  CHECK(desk.offers() == ControlsDesk::Names{"Pedals"});
  CHECK(desk.assistant.view(paper_gate(), false).offers.empty());  // not while a simulated driver drives
}

TEST_CASE("bindings that cannot be saved apply to this session, and the reason is said") {
  const TempFolder folder;
  std::ofstream(folder / "file") << "not a folder";
  for (const std::filesystem::path& file : {std::filesystem::path(), folder / "file" / "own.toml"}) {
    ControlsDesk desk(file);
    desk.frame();
    (void)desk.apply(StartControls{});
    desk.frame();
    desk.press_clutch();
    desk.enter();
    for (int i = 0; i < 3; ++i) (void)desk.apply(AnswerControls{ControlsSetup::Answer::skip});
    (void)desk.apply(AnswerControls{ControlsSetup::Answer::other});
    const std::string message = desk.apply(SaveControls{});
    CHECK(message.find("session only.") != std::string::npos);
    CHECK(desk.driver.bindings().clutch);
  }
}

TEST_CASE("in a sequential gate, neutral is locked on the way down only; on the way up the clutch is asked for") {
  const TempFolder folder;
  for (const auto& [engaged, button, request] :
       {std::tuple{1, 1u, "N is locked out. Hold the lift ring up (W) while you shift down."},
        std::tuple{kReverseGear, 0u, "The lever did not reach N. Press the clutch."}}) {
    ControlsDesk desk(folder / "own.toml");
    Bindings bindings = shipped_bindings();
    bindings.controllers = {{{"Box", ""}, 0, {{Action::shift_up, {0}}, {Action::shift_down, {1}}}, {}}};
    desk.driver.rebind(bindings);
    desk.driver.set_gate(shipped_gate(kSequentialGate), DeviceSpec{});
    desk.driver.feel({}, engaged);
    desk.frame();
    desk.all[1].buttons[button] = 1;
    desk.frame();
    desk.all[1].buttons[button] = 0;
    for (int i = 0; i < 500; ++i) desk.frame();
    CHECK(desk.assistant.view(shipped_gate(kSequentialGate), true).request == request);
  }
}

TEST_CASE("a shifter in a gear that the gate lacks, and one whose gear the lever is not in, are named in a sentence") {
  const TempFolder folder;
  ControlsDesk desk(folder / "own.toml");
  Bindings bindings = shipped_bindings();
  bindings.controllers = {{{"Box", ""}, 0, {}, {{3, {0}}, {6, {1}}}}};
  desk.driver.rebind(bindings);
  desk.driver.set_gate(paper_gate(), DeviceSpec{});
  desk.all[1].buttons[0] = 1;
  desk.frame();
  CHECK(desk.assistant.view(paper_gate(), true).request ==
        "Your shifter is in 3, but the lever is not. Press the clutch.");
  desk.all[1].buttons = {0, 1, 0, 0};
  for (int i = 0; i < 300; ++i) desk.frame();
  CHECK(desk.assistant.view(paper_gate(), true).request == "This gearbox has no gear 6.");
}

TEST_CASE("Escape cancels as the button does, but first releases the mouse; the driver does not get it") {
  const TempFolder folder;
  ControlsDesk desk(folder / "own.toml");
  desk.frame();
  (void)desk.apply(StartControls{});
  desk.press(GLFW_KEY_G);  // captures the mouse
  CHECK(desk.driver.mouse_moves_lever());
  desk.press(GLFW_KEY_ESCAPE);
  CHECK_FALSE(desk.driver.mouse_moves_lever());
  CHECK(desk.assistant.is_setting_up());
  CHECK(desk.message.empty());
  desk.keys = {{GLFW_KEY_ESCAPE, true, false, false, false}};
  desk.frame();
  CHECK_FALSE(desk.assistant.is_setting_up());
  CHECK(desk.message == "Cancelled: the controls are as before.");
  CHECK_FALSE(desk.driver.mouse_moves_lever());  // the same key captures the mouse at other times
}

TEST_CASE("from trying everything, Back returns to the last step, and its new answer is tried again") {
  const TempFolder folder;
  ControlsDesk desk(folder / "own.toml");
  desk.frame();
  (void)desk.apply(StartControls{});
  for (int i = 0; i < 4; ++i) (void)desk.apply(AnswerControls{ControlsSetup::Answer::skip});
  (void)desk.apply(AnswerControls{ControlsSetup::Answer::two_buttons});
  (void)desk.apply(AnswerControls{ControlsSetup::Answer::skip});
  const auto shift_down_by = [&](std::size_t button) {
    for (const bool down : {true, false}) {
      desk.all[1].buttons[button] = down;
      desk.frame();
    }
    desk.enter();
  };
  desk.frame();
  shift_down_by(0);
  CHECK_FALSE(hides(desk));
  CHECK(desk.driver.bindings().controllers.at(0).actions.at(Action::shift_down) == std::vector{0});
  (void)desk.apply(AnswerControls{ControlsSetup::Answer::back});
  CHECK(hides(desk));
  desk.frame();
  shift_down_by(3);
  CHECK(desk.driver.bindings().controllers.at(0).actions.at(Action::shift_down) == std::vector{3});
}

TEST_CASE("the gears of the gate in force are asked for") {
  const TempFolder folder;
  ControlsDesk desk(folder / "own.toml");
  desk.frame();
  (void)desk.assistant.apply(StartControls{}, shipped_gate("four_speed"));
  for (int i = 0; i < 4; ++i) (void)desk.apply(AnswerControls{ControlsSetup::Answer::skip});
  (void)desk.apply(AnswerControls{ControlsSetup::Answer::gear_buttons});
  const auto* setup = desk.assistant.view(paper_gate(), true).setup;
  CHECK(setup->steps() == 5 + 1 + 4 + 1);  // neutral, four gears, reverse
}

TEST_CASE("controllers that are declined are not offered at the next start, but when they are plugged in again") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "new" / "declined_controllers.txt";
  using Names = ControlsDesk::Names;
  {
    ControlsDesk desk(folder / "own.toml", file);
    desk.frame();
    CHECK(desk.offers() == Names{"Logitech G29", "Box"});
    CHECK(desk.apply(DeclineControls{}).empty());
    CHECK(desk.offers().empty());
  }
  ControlsDesk desk(folder / "own.toml", file);
  desk.all.push_back(controller("Pedals", {0.0f}));
  desk.frame();
  CHECK(desk.offers() == Names{"Pedals"});
  (void)desk.apply(DeclineControls{});
  desk.frame();
  CHECK(desk.offers().empty());
  const std::vector<Controller> all = std::exchange(desk.all, {desk.all[0]});
  desk.frame();
  desk.all = all;
  desk.frame();
  CHECK(desk.offers() == Names{"Box", "Pedals"});  // plugged in again
  (void)desk.apply(StartControls{});               // the panel's button works at any time
  CHECK(desk.assistant.is_setting_up());

  ControlsDesk later(folder / "own.toml", file);
  later.all = all;
  later.frame();
  CHECK(later.offers().empty());
  // The console does not name them either.
  later.all.push_back(controller("New", {0.0f}));
  later.frame();
  const std::vector<std::string>& sentences = later.assistant.sentences();
  REQUIRE(sentences.size() == 1);
  CHECK(sentences.front().starts_with("New was found."));
  later.all.back().axes = {0.5f};  // an axis that moves changes nothing
  later.frame();
  CHECK(sentences.size() == 1);
  Bindings bound = shipped_bindings();
  bound.controllers = {{{"New", ""}, 0, {{Action::shift_up, {0}}}, {}}};
  later.driver.rebind(bound);
  later.frame();
  REQUIRE(sentences.size() == 1);
  CHECK(sentences.front().starts_with("New reports 0 buttons, so its button 0 has no effect."));
  later.all.pop_back();
  later.frame();
  REQUIRE(sentences.size() == 1);
  CHECK(sentences.front().starts_with("New is not plugged in"));
}

TEST_CASE("if the answer cannot be saved, it is said and holds for this session") {
  const TempFolder folder;
  std::ofstream(folder / "file") << "not a folder";
  ControlsDesk desk(folder / "own.toml", folder / "file" / "declined_controllers.txt");
  desk.frame();
  const std::string message = desk.apply(DeclineControls{});
  CHECK(message.find("The controllers will be offered again at the next start.") != std::string::npos);
  desk.frame();
  CHECK(desk.offers().empty());
}
