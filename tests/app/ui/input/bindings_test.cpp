// Bindings: the shipped ones, the names of keys, and error messages with file, line and key.
#include "app/ui/input/bindings.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>

#include "app/ui/input/key_names.h"
#include "haptics/files/file_error.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

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

TEST_CASE("in the shipped bindings every action has a key, pedals and lever have an axis, the paces are the defaults") {
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
  CHECK(bindings.pedal_timing.pedal_time == Bindings{}.pedal_timing.pedal_time);
  CHECK(bindings.pedal_timing.slip_time == Bindings{}.pedal_timing.slip_time);
}

TEST_CASE("STOP works while the panel has the keyboard: one of its shipped keys types no text") {
  const Bindings bindings = read_bindings(shipped);
  const auto& keys = bindings.keys.at(Action::stop);
  CHECK(std::any_of(keys.begin(), keys.end(), [](int key) { return !types_text(key); }));
}

TEST_CASE("every action has a unique name and a description") {
  std::set<std::string_view> keys;
  std::set<Action> actions;
  for (const ActionInfo& action : all_actions()) {
    CHECK(keys.insert(action.key).second);
    CHECK(actions.insert(action.action).second);
    CHECK_FALSE(action.help.empty());
  }
  CHECK(actions.size() == static_cast<std::size_t>(Action::quit) + 1);
}

TEST_CASE("every GLFW key has a unique name, from which the key is found again") {
  CHECK(key_name(GLFW_KEY_A) == "A");
  CHECK(key_name(GLFW_KEY_7) == "7");
  CHECK(key_name(GLFW_KEY_F11) == "F11");
  CHECK(key_name(GLFW_KEY_LEFT_SHIFT) == "Left Shift");
  CHECK(key_name(GLFW_KEY_KP_4) == "Keypad 4");
  CHECK(key_name(999) == "Key 999");
  CHECK(key_label(GLFW_KEY_LEFT_BRACKET) == "[");
  CHECK(key_label(GLFW_KEY_COMMA) == ",");
  CHECK(key_label(GLFW_KEY_F11) == "F11");
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
  CHECK(known == 120);  // glfw3.h has 120 GLFW_KEY_ constants apart from UNKNOWN and LAST
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
  CHECK(bindings.pedal_timing.pedal_time == 1.0);
}

TEST_CASE("an error gives file, line, key, value and the allowed values") {
  CHECK(begins(refusal("[keys]\nstop = \"Spcae\"\n"),
               "my.toml:2: stop = \"Spcae\": \"Spcae\" is not valid; use a key such as"));
  CHECK(begins(refusal("[keys]\nstop = \"Space,\"\n"), "my.toml:2: stop = \"Space,\": \"\" is not valid; use a key"));
  CHECK(begins(refusal("[keys]\nstop = 5\n"), "my.toml:2: stop = 5: must be text in quotes"));
  CHECK(begins(refusal(stop + "jump = \"J\"\n"), "my.toml:3: jump is not a known key"));
  CHECK(begins(refusal(stop + "[seats]\n"), "my.toml:3: seats is not a known key"));
  CHECK(begins(refusal(stop + "[pad_buttons]\narm = \"A\"\n"),
               "my.toml:4: arm = \"A\": \"A\" is not valid; use a button number"));
  CHECK(begins(refusal(stop + "[pad_buttons]\narm = \"128\"\n"),
               "my.toml:4: arm = \"128\": \"128\" is not valid; use a button number"));
  CHECK(begins(refusal(stop + "[pace]\nmouse_mm_per_px = 0\n"),
               "my.toml:4: mouse_mm_per_px = 0: must be between 0.005 and 5"));
  CHECK(begins(refusal(stop + "[pace]\nlever_key_m_per_s = 3\n"), "my.toml:4: lever_key_m_per_s = 3: must be between"));
  CHECK(begins(refusal(stop + "[pace]\npedal_key_s = nan\n"), "my.toml:4: pedal_key_s = nan: must be between"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\npad = 0\n"), "my.toml:3: axis is missing"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = 1.5\n"), "my.toml:4: axis = 1.5: must be a whole number"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = 1\nfrom = 0.5\nto = 0.55\n"),
               "my.toml:6: to = 0.55: must differ from \"from\" (0.5) by at least 0.1"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = 1\ndead_zone = 1\n"), "my.toml:5: dead_zone = 1: must be"));
  CHECK(begins(refusal(stop + "[pad_axes.horn]\naxis = 1\n"), "my.toml:3: horn is not a known key"));
}

TEST_CASE("a key, button or axis bound twice is rejected, also within one list") {
  CHECK(begins(refusal(stop + "help = \"F1, Space\"\n"),
               "my.toml:3: help = \"F1, Space\": \"Space\" is already bound to stop"));
  CHECK(begins(refusal("[keys]\nstop = \"Space, Space\"\n"),
               "my.toml:2: stop = \"Space, Space\": \"Space\" is already bound to stop"));
  CHECK(begins(refusal(stop + "[pad_buttons]\narm = \"1\"\nstop = \"1\"\n"),
               "my.toml:5: stop = \"1\": \"1\" is already bound to arm"));
  CHECK(begins(refusal(stop + "[pad_axes.throttle]\naxis = 1\n[pad_axes.clutch]\naxis = 1\n"),
               "my.toml:6: axis = 1: is already bound to throttle"));
  CHECK(refusal(stop + "[pad_axes.throttle]\naxis = 1\n[pad_axes.clutch]\naxis = 1\npad = 1\n") == "accepted");
  CHECK(refusal(stop + "[pad_axes.throttle]\naxis = 1\n[pad_axes.clutch]\naxis = 1\nstick = \"Pedals\"\n") ==
        "accepted");
}

TEST_CASE("throttle and brake may be the two halves of one axis, but must not overlap") {
  const std::string throttle = stop + "[pad_axes.throttle]\naxis = 1\nfrom = 0\nto = 1\n[pad_axes.brake]\naxis = 1\n";
  CHECK(refusal(throttle + "from = 0\nto = -1\n") == "accepted");
  CHECK(begins(refusal(throttle + "from = 0.1\nto = -1\n"), "my.toml:8: axis = 1: is already bound to throttle"));
  // Measured rests may differ by a count; the dead zone has room for it.
  CHECK(refusal(throttle + "from = 0.004\nto = -1\ndead_zone = 0.02\n") == "accepted");
}

TEST_CASE("sticks that are absent, and those that nobody has set up, are told; game pads need no setting up") {
  using gearshift::engine::PadState;
  const Bindings bindings = bindings_of(stop +
                                        "[pad_buttons]\nstick = \"Box\"\narm = \"3\"\n"
                                        "[pad_axes.throttle]\nstick = \"Pedals\"\naxis = 0\n"
                                        "[pad_axes.brake]\nstick = \"Pedals\"\naxis = 1\n");
  const PadState pad{"X-Box pad", {0.0f}, {}, "x", true}, wheel{"Wheel", {0.0f}, {}, "w", false},
      pedals{"Acme Pedals", {0.0f}, {}, "p", false}, keyboard{"Keyboard", {}, {0}, "k", false},
      box{"Button Box", {}, {0}, "b", false};
  CHECK(describe_unbound(bindings, {pad, pedals, keyboard, box}).empty());
  CHECK(
      describe_unbound(bindings, {pad, wheel, box}) ==
      std::vector<std::string>{
          "Pedals is not plugged in, so it moves no throttle, brake; plug it in, or run: gearshift devices --calibrate",
          "Wheel was found; it moves nothing until you set it up: gearshift devices --calibrate"});
}

TEST_CASE("stick names, a lever's rest, both dead zones and the lever mode are read as written") {
  const Bindings bindings = bindings_of(
      stop +
      "[pad_buttons]\nstick = \"Wheel\"\narm = \"3\"\n"
      "[pad_axes.lever_select]\nstick = \"T.16000M\"\naxis = 0\ncentre = 0.1\ndead_zone = 0.1\nend_zone = 0.05\n"
      "[lever]\nmode = \"places\"\nfull_speed_m_per_s = 0.5\n");
  CHECK(bindings.button_stick == "Wheel");
  REQUIRE(bindings.lever_select);
  CHECK(bindings.lever_select->stick == "T.16000M");
  CHECK(bindings.lever_select->centre == 0.1);
  CHECK(bindings.lever_select->end_zone == 0.05);
  CHECK(bindings.lever_mode == LeverMode::places);
  CHECK(bindings.stick_speed == 0.5);
  CHECK(bindings_of(stop).lever_mode == LeverMode::moves);
  CHECK(help_text(bindings).find("T.16000M axis 0\tmove the lever sideways\n") != std::string::npos);
  CHECK(help_text(bindings).find("Wheel button 3\tturn forces on") != std::string::npos);
  const std::string axis = stop + "[pad_axes.lever_select]\naxis = 0\n";
  CHECK(begins(refusal(axis + "centre = 0.95\n"),
               "my.toml:5: centre = 0.95: must lie well between \"from\" (-1) and \"to\" (1)"));
  CHECK(begins(refusal(axis + "dead_zone = 0.5\nend_zone = 0.6\n"),
               "my.toml:6: end_zone = 0.6: the sum of end_zone and dead_zone (0.5) must not exceed 0.95"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = 0\ncentre = 0\n"), "my.toml:5: centre is not a known key"));
  CHECK(begins(refusal(stop + "[lever]\nmode = \"jumps\"\n"), "my.toml:4: mode = \"jumps\": must be"));
  CHECK(begins(refusal(stop + "[lever]\nfull_speed_m_per_s = 3\n"), "my.toml:4: full_speed_m_per_s = 3: must be"));
}

TEST_CASE("the shipped bindings include a pad's stop button") {
  CHECK(read_bindings(shipped).pad_buttons.contains(Action::stop));
}

TEST_CASE("bindings that are written and read again are equal: the shipped ones and complete ones") {
  Bindings full = read_bindings(shipped);
  full.button_stick = "a \"quoted\" \\ stick";
  full.lever_select->stick = "Stick";
  full.lever_select->centre = 0.1234567890123456;
  full.lever_select->end_zone = 1.0 / 3.0;
  full.lever_mode = LeverMode::places;
  full.stick_speed = 0.1;
  full.pedal_timing.slip_time = 2.5;
  for (const Bindings& bindings : {read_bindings(shipped), full}) {
    const TempFolder folder;
    const std::filesystem::path file = user_bindings_file(folder / "config", "mine");
    CHECK(file == folder / "config" / "bindings" / "mine.toml");
    std::filesystem::create_directories(file.parent_path());
    write_bindings(bindings, file);
    const Bindings back = read_bindings(file);
    CHECK(bindings_text(back) == bindings_text(bindings));
    CHECK(back.keys == bindings.keys);
    CHECK(back.pad_buttons == bindings.pad_buttons);
    CHECK(back.button_stick == bindings.button_stick);
    REQUIRE(back.lever_select);
    CHECK(back.lever_select->stick == bindings.lever_select->stick);
    CHECK(back.lever_select->centre == bindings.lever_select->centre);
    CHECK(back.lever_select->end_zone == bindings.lever_select->end_zone);
    CHECK(back.lever_shift->from == bindings.lever_shift->from);
    CHECK(back.lever_mode == bindings.lever_mode);
    CHECK(back.stick_speed == bindings.stick_speed);
    CHECK(back.pedal_timing.slip_time == bindings.pedal_timing.slip_time);
  }
}

TEST_CASE(
    "bindings that could not be read again or have an invalid file name are not written, and the old file is kept") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "mine.toml";
  write_bindings(read_bindings(shipped), file);
  Bindings broken = read_bindings(shipped);
  broken.keys.erase(Action::stop);
  CHECK_THROWS_WITH_AS(write_bindings(broken, file),
                       doctest::Contains("it could not be read back: [keys] has no key for stop"), FileError);
  CHECK(read_bindings(file).keys.contains(Action::stop));
  for (const char* name : {"", ".hidden", "../up", "a/b"})
    CHECK_THROWS_AS((void)user_bindings_file(folder / "config", name), std::invalid_argument);
}

TEST_CASE("bindings without a key for STOP are rejected") {
  CHECK(refusal("") == "my.toml:1: [keys] has no key for stop; set one, so that you can always turn forces off");
  CHECK(refusal(stop) == "accepted");
}

TEST_CASE("the help lists every bound key with its action") {
  const Bindings bindings = read_bindings(shipped);
  const std::string help = help_text(bindings);
  CHECK(help.find("F11\tswitch between full screen and window\n") != std::string::npos);
  CHECK(help.find("Space, F12\tstop (turn forces off)\n") != std::string::npos);
  CHECK(help.find("Pad RT\tthrottle\n") != std::string::npos);
  CHECK(help_text({}).find("F1\t") == std::string::npos);
  CHECK(std::count(help.begin(), help.end(), '\t') == std::count(help.begin(), help.end(), '\n'));
}
