// Setting up controllers in the window: what is offered, what drives meanwhile, and what is saved.
#include "app/session/controls_assistant.h"

#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

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
  explicit ControlsDesk(const std::filesystem::path& own_file) : assistant(driver, own_file, shipped_bindings()) {}

  void frame() {
    assistant.update(all, 0.01);
    WindowInput input;
    input.controllers = assistant.hides_controllers() ? std::vector<Controller>{} : all;
    driver.update(input, 0.01, false, false);
  }
  void press_clutch() {
    for (int i = -20; i <= 20; ++i) {
      all[0].axes[1] = static_cast<float>(std::abs(i)) / 10.0f - 1.0f;
      frame();
    }
  }
  std::string enter() {
    std::string message;
    CHECK(assistant.press_enter(message));
    for (int i = 0; i < 200; ++i) frame();
    return message;
  }
  std::string offer() { return std::string(assistant.view(paper_gate(), true).offer); }

  std::vector<Controller> all{controller("Logitech G29", {0.0f, 1.0f}, 25, "046d:c24f"), controller("Box", {}, 4),
                              gamepad({})};
  DriverInput driver{{shipped_bindings()}};
  ControlsAssistant assistant;
};

}  // namespace

TEST_CASE("a wheel is set up and saved: meanwhile it does not drive, at the end it can be tried, then it works") {
  const TempFolder folder;
  ControlsDesk desk(folder / "bindings" / "own.toml");
  desk.frame();
  CHECK(desk.offer() == "Logitech G29");
  CHECK(desk.assistant.apply(StartControls{}).empty());
  CHECK(desk.assistant.hides_controllers());
  CHECK(desk.assistant.view(paper_gate(), true).setup != nullptr);
  for (int i = 0; i < 5; ++i) desk.frame();
  desk.press_clutch();
  CHECK(desk.enter().empty());
  CHECK(desk.driver.controls().pedals.clutch == 0.0);
  for (int i = 0; i < 3; ++i) (void)desk.assistant.apply(AnswerControls{ControlsSetup::Answer::skip});
  (void)desk.assistant.apply(AnswerControls{ControlsSetup::Answer::other});
  desk.frame();
  CHECK_FALSE(desk.assistant.hides_controllers());
  desk.all[0].axes[1] = 0.5f;
  desk.frame();
  desk.all[0].axes[1] = -1.0f;
  desk.frame();
  CHECK(desk.driver.controls().pedals.clutch == 1.0);
  CHECK(desk.enter() == "Saved: " + (folder / "bindings" / "own.toml").string());
  CHECK(read_bindings(folder / "bindings" / "own.toml").clutch->of.stick == "Logitech G29");
  std::string message;
  CHECK_FALSE(desk.assistant.press_enter(message));
  CHECK(desk.offer() == "Box");
}

TEST_CASE("after cancelling the old bindings apply; a declined controller is not offered again") {
  const TempFolder folder;
  ControlsDesk desk(folder / "own.toml");
  desk.frame();
  (void)desk.assistant.apply(StartControls{});
  desk.frame();
  desk.press_clutch();
  desk.enter();
  (void)desk.assistant.apply(CancelControls{});
  CHECK_FALSE(desk.driver.bindings().clutch);
  CHECK_FALSE(std::filesystem::exists(folder / "own.toml"));
  (void)desk.assistant.apply(DeclineControls{});
  desk.frame();
  CHECK(desk.offer().empty());
  desk.all.push_back(controller("Pedals", {0.0f}));  // another one, plugged in later
  desk.frame();
  CHECK(desk.offer() == "Pedals");
  CHECK(desk.assistant.view(paper_gate(), false).offer.empty());  // not while a simulated driver drives
}

TEST_CASE("bindings that cannot be saved apply to this session, and the reason is said") {
  const TempFolder folder;
  std::ofstream(folder / "file") << "not a folder";
  for (const std::filesystem::path& file : {std::filesystem::path(), folder / "file" / "own.toml"}) {
    ControlsDesk desk(file);
    desk.frame();
    (void)desk.assistant.apply(StartControls{});
    desk.frame();
    desk.press_clutch();
    desk.enter();
    for (int i = 0; i < 3; ++i) (void)desk.assistant.apply(AnswerControls{ControlsSetup::Answer::skip});
    (void)desk.assistant.apply(AnswerControls{ControlsSetup::Answer::other});
    const std::string message = desk.assistant.apply(SaveControls{});
    CHECK(message.find("session only.") != std::string::npos);
    CHECK(desk.driver.bindings().clutch);
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
