// Pedals and a lever without forces, demonstrated one after another by a simulated user.
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

// Up to three pedals on axes 0 to 2 of one device, released at 1 and pressed at -1; a lever on the two axes of another.
struct Person {
  std::vector<PadState> sticks{{"Pedals", {1.0f, 1.0f, 1.0f}, {}, "guid-p"}, {"Shifter", {0.0f, 0.0f}, {}, "guid-s"}};
  int asked = 0, frames = 0;
  std::vector<std::string> said;

  float* moved(const std::string& question) {
    if (question.find("CLUTCH") != std::string::npos) return &sticks[0].axes[2];
    if (question.find("BRAKE") != std::string::npos) return &sticks[0].axes[1];
    if (question.find("left") != std::string::npos) return &sticks[1].axes[0];
    if (question.find("forward") != std::string::npos) return &sticks[1].axes[1];
    return nullptr;
  }

  AxisDialog dialog(const std::function<std::string(const std::string&)>& types) {
    AxisDialog dialog;
    dialog.print = [this](const std::string& line) { said.push_back(line); };
    dialog.next_frame = [this] { return sticks; };
    dialog.ask = [this, types](const std::string& question, const std::function<void()>& frame) {
      ++asked;
      std::string answer = types(question);
      float* axis = answer.empty() ? moved(question) : nullptr;
      const float rest = axis != nullptr ? *axis : 0.0f;
      const bool lever = question.find("LEVER") != std::string::npos;
      for (int i = 0; i <= 60; ++i) {
        const float share = i < 30 ? static_cast<float>(i) / 30.0f : static_cast<float>(60 - i) / 30.0f;
        if (axis != nullptr && !lever) *axis = rest - 2.0f * share;
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

TEST_CASE("each axis is the one that was moved, reversed if necessary; a skipped one keeps its binding") {
  Person person;
  Bindings before;
  before.throttle = AxisBinding{};
  before.throttle->stick = "another";
  const Bindings after = learn_axes(before, person.dialog([](const std::string& question) {
    if (is_question_for(question, "THROTTLE")) return "-";
    return is_question_for(question, "stay where you leave it") ? "y" : "";
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

TEST_CASE("no movement and invalid words are reported and asked again; without a lever its mode is not asked") {
  Person person;
  int clutch = 0, throttle = 0;
  const Bindings after = learn_axes({}, person.dialog([&](const std::string& question) -> std::string {
    CHECK_FALSE(is_question_for(question, "stay where you leave it"));
    if (is_question_for(question, "CLUTCH")) return clutch++ == 0 ? "what" : "";
    // presses nothing, then skips the pedal
    if (is_question_for(question, "THROTTLE")) return throttle++ == 0 ? "" : "-";
    return "-";
  }));
  CHECK(after.clutch.has_value());
  CHECK_FALSE(after.throttle.has_value());
  CHECK(clutch == 2);
  CHECK(throttle == 2);
  const auto has_printed = [&](const char* words) {
    return std::any_of(person.said.begin(), person.said.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
  };
  CHECK(has_printed("\"what\" is not a valid answer"));
  CHECK(has_printed("Rejected: "));
}

TEST_CASE("starting over begins without the user's axes, and does not touch the saved ones") {
  const TempFolder folder;
  const std::filesystem::path own = folder / "own.toml", defaults = GEARSHIFT_ASSETS "/bindings/default.toml";
  CHECK_FALSE(starting_bindings(own, defaults, false).clutch.has_value());  // there is none
  Bindings kept = read_bindings(defaults);
  kept.clutch = AxisBinding{};
  kept.clutch->stick = "Pedals";
  write_bindings(kept, own);
  REQUIRE(starting_bindings(own, defaults, false).clutch.has_value());
  CHECK(starting_bindings(own, defaults, false).clutch->stick == "Pedals");
  CHECK_FALSE(starting_bindings(own, defaults, true).clutch.has_value());
  CHECK(read_bindings(own).clutch->stick == "Pedals");
}
