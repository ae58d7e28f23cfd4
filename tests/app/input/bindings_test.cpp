// Bindings: what is shipped, the names of keys, and refusals with file, line and key.
#include "app/input/bindings.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>

#include "app/input/key_names.h"
#include "haptics/files/file_error.h"
#include "tests/support/temp_folder.h"

using namespace gearshift;

namespace {

const std::string shipped = GEARSHIFT_ASSETS "/bindings/default.toml";

Bindings bindings_of(const std::string& text) {
  const TempFolder folder;
  const std::filesystem::path file = folder / "my.toml";
  std::ofstream(file) << text;
  return read_bindings(file);
}

std::string refusal(const std::string& text) {
  try {
    bindings_of(text);
  } catch (const FileError& error) {
    const std::string sentence = error.what();
    return sentence.substr(sentence.find("my.toml"));
  }
  return "accepted";
}

bool begins(const std::string& text, const std::string& with) {
  return text.rfind(with, 0) == 0;
}

const std::string stop = "[keys]\nstop = \"Space\"\n";

}  // namespace

TEST_CASE("the shipped bindings: every action has a key, pedals and lever have an axis, the paces are the defaults") {
  const Bindings bindings = read_bindings(shipped);
  for (const ActionInfo& action : all_actions()) {
    CAPTURE(action.key);
    CHECK(bindings.keys.contains(action.action));
  }
  CHECK(bindings.keys.at(Action::help) == std::vector{GLFW_KEY_F1});
  CHECK(bindings.keys.at(Action::recentre) == std::vector{GLFW_KEY_R});
  CHECK(bindings.keys.at(Action::full_screen) == std::vector{GLFW_KEY_F11});
  CHECK(bindings.keys.at(Action::lever_forward) == std::vector{GLFW_KEY_UP});
  CHECK((bindings.lever_select && bindings.lever_shift && bindings.throttle && bindings.brake));
  CHECK(bindings.lever_shift->from == 1.0);
  CHECK(bindings.mouse_mm_per_px == Bindings{}.mouse_mm_per_px);
  CHECK(bindings.key_speed == Bindings{}.key_speed);
  CHECK(bindings.pedal_time == Bindings{}.pedal_time);
  CHECK(bindings.clutch_slip_time == Bindings{}.clutch_slip_time);
}

TEST_CASE("the stop can be reached while the panel has the keyboard: one of its shipped keys types nothing") {
  const Bindings bindings = read_bindings(shipped);
  const auto& keys = bindings.keys.at(Action::stop);
  CHECK(std::any_of(keys.begin(), keys.end(), [](int key) { return !types_text(key); }));
}

TEST_CASE("every action has a name, words, and no other action's") {
  std::set<std::string_view> keys;
  std::set<Action> actions;
  for (const ActionInfo& action : all_actions()) {
    CHECK(keys.insert(action.key).second);
    CHECK(actions.insert(action.action).second);
    CHECK_FALSE(action.says.empty());
  }
  CHECK(actions.size() == static_cast<std::size_t>(Action::quit) + 1);
}

TEST_CASE("every key of GLFW has a name of its own, and the name gives the key") {
  CHECK(key_name(GLFW_KEY_A) == "A");
  CHECK(key_name(GLFW_KEY_7) == "7");
  CHECK(key_name(GLFW_KEY_F11) == "F11");
  CHECK(key_name(GLFW_KEY_LEFT_SHIFT) == "Left Shift");
  CHECK(key_name(GLFW_KEY_KP_4) == "Keypad 4");
  CHECK(key_name(999) == "Key 999");
  CHECK_FALSE(key_of("Key 999"));
  CHECK_FALSE(key_of("a"));
  CHECK_FALSE(key_of(""));
  std::set<std::string> names;
  int known = 0;
  for (int key = 0; key <= GLFW_KEY_LAST; ++key) {
    if (begins(key_name(key), "Key ")) continue;
    ++known;
    CHECK(names.insert(key_name(key)).second);
    CHECK(key_of(key_name(key)) == key);
  }
  CHECK(known == 120);  // GLFW_KEY_... in glfw3.h, GLFW_KEY_UNKNOWN and GLFW_KEY_LAST left out
}

TEST_CASE("several keys for one action, buttons and axes are read as written") {
  const Bindings bindings = bindings_of(
      "[keys]\nstop = \"Space, Left Shift ,Comma\"\n[pad_buttons]\narm = \"3, 12\"\n"
      "[pad_axes.clutch]\npad = 1\naxis = 4\nfrom = 1\nto = -0.5\ndead_zone = 0.25\n"
      "[pace]\nmouse_mm_per_px = 0.3\nlever_key_m_per_s = 0.5\npedal_key_s = 1\n");
  CHECK(bindings.keys.at(Action::stop) == std::vector{GLFW_KEY_SPACE, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_COMMA});
  CHECK(bindings.keys.size() == 1);
  CHECK(bindings.pad_buttons.at(Action::arm) == std::vector{3, 12});
  REQUIRE(bindings.clutch);
  CHECK(bindings.clutch->pad == 1);
  CHECK(bindings.clutch->axis == 4);
  CHECK(bindings.clutch->from == 1.0);
  CHECK(bindings.clutch->to == -0.5);
  CHECK(bindings.clutch->dead_zone == 0.25);
  CHECK_FALSE(bindings.throttle);
  CHECK(bindings.mouse_mm_per_px == 0.3);
  CHECK(bindings.key_speed == 0.5);
  CHECK(bindings.pedal_time == 1.0);
}

TEST_CASE("refusals name file, line, key, value and what is allowed") {
  CHECK(begins(refusal("[keys]\nstop = \"Spcae\"\n"), "my.toml:2: stop = \"Spcae\": \"Spcae\" must be a key such as"));
  CHECK(begins(refusal("[keys]\nstop = \"Space,\"\n"), "my.toml:2: stop = \"Space,\": \"\" must be a key"));
  CHECK(begins(refusal("[keys]\nstop = 5\n"), "my.toml:2: stop = 5: must be a text in quotes"));
  CHECK(begins(refusal(stop + "jump = \"J\"\n"), "my.toml:3: jump is not a known key"));
  CHECK(begins(refusal(stop + "[seats]\n"), "my.toml:3: seats is not a known key"));
  CHECK(begins(refusal(stop + "[pad_buttons]\narm = \"A\"\n"),
               "my.toml:4: arm = \"A\": \"A\" must be a button's number"));
  CHECK(begins(refusal(stop + "[pad_buttons]\narm = \"128\"\n"), "my.toml:4: arm = \"128\": \"128\" must be"));
  CHECK(begins(refusal(stop + "[pace]\nmouse_mm_per_px = 0\n"),
               "my.toml:4: mouse_mm_per_px = 0: must be between 0.005 and 5"));
  CHECK(begins(refusal(stop + "[pace]\nlever_key_m_per_s = 3\n"), "my.toml:4: lever_key_m_per_s = 3: must be between"));
  CHECK(begins(refusal(stop + "[pace]\npedal_key_s = nan\n"), "my.toml:4: pedal_key_s = nan: must be between"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\npad = 0\n"), "my.toml:3: axis is missing"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = 1.5\n"), "my.toml:4: axis = 1.5: must be a whole number"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = 1\nfrom = 0.5\nto = 0.55\n"),
               "my.toml:6: to = 0.55: must be at least 0.1 away from from = 0.5"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = 1\ndead_zone = 1\n"), "my.toml:5: dead_zone = 1: must be"));
  CHECK(begins(refusal(stop + "[pad_axes.horn]\naxis = 1\n"), "my.toml:3: horn is not a known key"));
}

TEST_CASE("what does two things is refused: a key, a button, an axis; the same one listed twice, too") {
  CHECK(
      begins(refusal(stop + "help = \"F1, Space\"\n"), "my.toml:3: help = \"F1, Space\": \"Space\" does stop already"));
  CHECK(
      begins(refusal("[keys]\nstop = \"Space, Space\"\n"), "my.toml:2: stop = \"Space, Space\": \"Space\" does stop"));
  CHECK(
      begins(refusal(stop + "[pad_buttons]\narm = \"1\"\nstop = \"1\"\n"), "my.toml:5: stop = \"1\": \"1\" does arm"));
  CHECK(begins(refusal(stop + "[pad_axes.throttle]\naxis = 1\n[pad_axes.clutch]\naxis = 1\n"),
               "my.toml:6: axis = 1: does throttle already"));
  CHECK(refusal(stop + "[pad_axes.throttle]\naxis = 1\n[pad_axes.clutch]\naxis = 1\npad = 1\n") == "accepted");
}

TEST_CASE("without a key that stops the motors there are no bindings") {
  CHECK(refusal("") == "my.toml:1: [keys] has no stop: one key must turn the motors off");
  CHECK(refusal(stop) == "accepted");
}

TEST_CASE("the help names every bound key with what it does") {
  const Bindings bindings = read_bindings(shipped);
  const std::string help = help_text(bindings);
  CHECK(help.find("F11\tfull screen or window\n") != std::string::npos);
  CHECK(help.find("Space, F12\tstop: motors off\n") != std::string::npos);
  CHECK(help.find("Pad axis 5\tthrottle\n") != std::string::npos);
  CHECK(help_text({}).find("F1\t") == std::string::npos);
  CHECK(std::count(help.begin(), help.end(), '\t') == std::count(help.begin(), help.end(), '\n'));
}
