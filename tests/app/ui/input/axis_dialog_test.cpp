// The dialog that learns the axes of pedals and of a lever without force feedback. A simulated user moves them one
// after the other.
#include "app/ui/input/axis_dialog.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>

#include <doctest/doctest.h>

#include "app/runtime/devices/calibration_dialog.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::engine;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

// A user with two devices. The first has pedals on its three axes (1 released, -1 pressed), the second has a lever on
// its two axes. When asked for a control, the user moves that control.
struct Person {
  std::vector<PadState> sticks{{"Pedals", {1.0f, 1.0f, 1.0f}, {}, "guid-p"}, {"Shifter", {0.0f, 0.0f}, {}, "guid-s"}};
  int asked = 0, frames = 0;
  std::vector<std::string> printed;

  float* moved(const std::string& question) {
    if (question.find("CLUTCH") != std::string::npos) return &sticks[0].axes[2];
    if (question.find("BRAKE") != std::string::npos) return &sticks[0].axes[1];
    if (question.find("left") != std::string::npos) return &sticks[1].axes[0];
    if (question.find("forward") != std::string::npos) return &sticks[1].axes[1];
    return nullptr;
  }

  AxisDialog dialog(const std::function<std::string(const std::string&)>& types) {
    AxisDialog dialog;
    dialog.print = [this](const std::string& line) { printed.push_back(line); };
    dialog.next_frame = [this] { return sticks; };
    dialog.ask = [this, types](const std::string& question, const std::function<void()>& frame) {
      ++asked;
      std::string answer = types(question);
      float* axis = answer.empty() ? moved(question) : nullptr;
      const float rest = axis != nullptr ? *axis : 0.0f;
      const bool lever = question.find("LEVER") != std::string::npos;
      for (int i = 0; i <= 60; ++i) {
        const float fraction = i < 30 ? static_cast<float>(i) / 30.0f : static_cast<float>(60 - i) / 30.0f;
        if (axis != nullptr && !lever) *axis = rest - 2.0f * fraction;
        if (axis != nullptr && lever) *axis = i < 20 ? -1.0f : i < 40 ? 1.0f : 0.0f;
        frame();
      }
      if (axis != nullptr) *axis = rest;
      return answer;
    };
    return dialog;
  }
};

bool is_question_for(const std::string& question, const char* words) {
  return question.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("each binding gets the axis that was moved, reversed if necessary; a skipped one is kept") {
  Person person;
  Bindings before;
  before.throttle = AxisBinding{};
  before.throttle->stick = "another";
  const Bindings after = learn_axes(before, person.dialog([](const std::string& question) {
    if (is_question_for(question, "THROTTLE")) return "-";
    return is_question_for(question, "stay in place") ? "y" : "";
  }));
  REQUIRE(after.clutch.has_value());
  CHECK(after.clutch->stick == "Pedals");
  CHECK(after.clutch->axis == 2);
  CHECK(pedal_value(*after.clutch, 1.0) == 0.0);
  CHECK(pedal_value(*after.clutch, -1.0) == 1.0);
  CHECK(after.brake->axis == 1);
  CHECK(after.throttle->stick == "another");
  CHECK(lever_value(*after.lever_select, -1.0) == -1.0);
  CHECK(after.lever_shift->axis == 1);
  CHECK(after.lever_mode == LeverMode::places);
}

TEST_CASE(
    "missing movements and invalid words are reported and asked for again; without a lever its mode is not asked") {
  Person person;
  int clutch = 0, throttle = 0;
  const Bindings after = learn_axes({}, person.dialog([&](const std::string& question) -> std::string {
    CHECK_FALSE(is_question_for(question, "stay in place"));
    if (is_question_for(question, "CLUTCH")) return clutch++ == 0 ? "what" : "";
    // At the first question the user presses no pedal. At the second question the user skips the throttle.
    if (is_question_for(question, "THROTTLE")) return throttle++ == 0 ? "" : "-";
    return "-";
  }));
  CHECK(after.clutch.has_value());
  CHECK_FALSE(after.throttle.has_value());
  CHECK(clutch == 2);
  CHECK(throttle == 2);
  const auto has_printed = [&](const char* words) {
    return std::any_of(person.printed.begin(), person.printed.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
  };
  CHECK(has_printed("\"what\" is not a valid answer"));
  CHECK(has_printed(" Try again."));
}

TEST_CASE("starting over begins without the user's axes, and does not change the saved ones") {
  const TempFolder folder;
  const std::filesystem::path own = folder / "own.toml", defaults = GEARSHIFT_ASSETS "/bindings/default.toml";
  CHECK_FALSE(starting_bindings(own, defaults, false).clutch.has_value());  // the user has no bindings file yet
  Bindings saved = read_bindings(defaults);
  saved.clutch = AxisBinding{};
  saved.clutch->stick = "Pedals";
  write_bindings(saved, own);
  REQUIRE(starting_bindings(own, defaults, false).clutch.has_value());
  CHECK(starting_bindings(own, defaults, false).clutch->stick == "Pedals");
  CHECK_FALSE(starting_bindings(own, defaults, true).clutch.has_value());
  CHECK(read_bindings(own).clutch->stick == "Pedals");
}
