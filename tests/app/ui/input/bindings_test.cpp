// Bindings: the shipped ones, the names of keys, and error messages with file, line and key.
#include "app/ui/input/bindings.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <doctest/doctest.h>

#include "app/ui/input/bound_controllers.h"
#include "app/ui/input/key_names.h"
#include "haptics/files/file_error.h"
#include "tests/support/controllers.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::engine;
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
  CHECK(bindings.pace.mouse_mm_per_px == Bindings{}.pace.mouse_mm_per_px);
  CHECK(bindings.pace.key_speed == Bindings{}.pace.key_speed);
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
      "[keys]\nstop = \"Space, Left Shift ,Comma\"\n[pad_buttons]\narm = \"y, dpad_right\"\n"
      "[pad_axes.clutch]\npad = 1\naxis = \"lt\"\nfrom = 1\nto = -0.5\ndead_zone = 0.25\n"
      "[pace]\nmouse_mm_per_px = 0.3\nlever_key_m_per_s = 0.5\npedal_key_s = 1\n");
  CHECK(bindings.keys.at(Action::stop) == std::vector{GLFW_KEY_SPACE, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_COMMA});
  CHECK(bindings.keys.size() == 1);
  CHECK(bindings.pad_buttons.at(Action::arm) == std::vector{GLFW_GAMEPAD_BUTTON_Y, GLFW_GAMEPAD_BUTTON_DPAD_RIGHT});
  REQUIRE(bindings.clutch);
  CHECK(bindings.clutch->which == 1);
  CHECK(bindings.clutch->axis == GLFW_GAMEPAD_AXIS_LEFT_TRIGGER);
  CHECK(bindings.clutch->from == 1.0);
  CHECK(bindings.clutch->to == -0.5);
  CHECK(bindings.clutch->dead_zone == 0.25);
  CHECK_FALSE(bindings.throttle);
  CHECK(bindings.pace.mouse_mm_per_px == 0.3);
  CHECK(bindings.pace.key_speed == 0.5);
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
               "my.toml:4: arm = \"A\": \"A\" is not valid; use one of a, b, x, y, lb"));
  CHECK(begins(refusal(stop + "[pad_buttons]\narm = \"7\"\n"),
               "my.toml:4: arm = \"7\": \"7\" is not valid; use one of a, b"));
  CHECK(begins(refusal(stop + "[[controller]]\nstick = \"Box\"\narm = \"528\"\n"),
               "my.toml:5: arm = \"528\": \"528\" is not valid; use a button number from 0 to 527"));
  CHECK(begins(refusal(stop + "[[controller]]\narm = \"5\"\n"), "my.toml:3: stick is missing: it must be text"));
  CHECK(begins(refusal(stop + "[pace]\nmouse_mm_per_px = 0\n"),
               "my.toml:4: mouse_mm_per_px = 0: must be between 0.005 and 5"));
  CHECK(begins(refusal(stop + "[pace]\nlever_key_m_per_s = 3\n"),
               "my.toml:4: lever_key_m_per_s = 3: must be between 0.01 and 2"));
  CHECK(begins(refusal(stop + "[pace]\npedal_key_s = 6\n"), "my.toml:4: pedal_key_s = 6: must be between 0.01 and 5"));
  CHECK(begins(refusal(stop + "[pace]\nclutch_key_slip_s = 11\n"),
               "my.toml:4: clutch_key_slip_s = 11: must be between 0.01 and 10"));
  CHECK(begins(refusal(stop + "[lever]\nfull_speed_m_per_s = 3\n"),
               "my.toml:4: full_speed_m_per_s = 3: must be between 0.01 and 2"));
  CHECK(begins(refusal(stop + "[lever]\nmode = \"jumps\"\n"),
               "my.toml:4: mode = \"jumps\": must be one of moves, places, steps"));
  CHECK(begins(refusal(stop + "[pace]\npedal_key_s = nan\n"), "my.toml:4: pedal_key_s = nan: must be between"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\npad = 0\n"), "my.toml:3: axis is missing"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\nstick = \"G29\"\n"), "my.toml:3: axis is missing"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\nstick = \"G29\"\naxis = 1.5\n"),
               "my.toml:5: axis = 1.5: must be a whole number"));
  CHECK(
      refusal(stop + "[pad_axes.clutch]\naxis = 2\n") ==
      "my.toml:4: axis = 2: an axis number needs \"stick\", the controller's name; for any game pad use a name such as "
      "\"lt\"");
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = \"left\"\n"),
               "my.toml:4: axis = \"left\": must be one of left_x, left_y, right_x"));
  CHECK(begins(refusal(stop + "[pad_axes.clutch]\naxis = \"lt\"\nfrom = 0.5\nto = 0.55\n"),
               "my.toml:6: to = 0.55: must differ from \"from\" (0.5) by at least 0.1"));
  CHECK(
      begins(refusal(stop + "[pad_axes.clutch]\naxis = \"lt\"\ndead_zone = 1\n"), "my.toml:5: dead_zone = 1: must be"));
  CHECK(begins(refusal(stop + "[pad_axes.horn]\naxis = \"lt\"\n"), "my.toml:3: horn is not a known key"));
}

TEST_CASE("a key, button or axis bound twice is rejected, also within one list") {
  CHECK(begins(refusal(stop + "help = \"F1, Space\"\n"),
               "my.toml:3: help = \"F1, Space\": \"Space\" is already bound to stop"));
  CHECK(begins(refusal("[keys]\nstop = \"Space, Space\"\n"),
               "my.toml:2: stop = \"Space, Space\": \"Space\" is already bound to stop"));
  CHECK(begins(refusal(stop + "[pad_buttons]\narm = \"b\"\nstop = \"b\"\n"),
               "my.toml:5: stop = \"b\": \"b\" is already bound to arm"));
  CHECK(begins(refusal(stop + "[[controller]]\nstick = \"Box\"\narm = \"1\"\ngear_1 = \"1\"\n"),
               "my.toml:6: gear_1 = \"1\": \"1\" is already bound to arm"));
  CHECK(begins(refusal(stop + "[[controller]]\nstick = \"Box\"\n[[controller]]\nstick = \"Box\"\n"),
               "my.toml:6: stick = \"Box\": has another [[controller]] already"));
  const std::string throttle = stop + "[pad_axes.throttle]\naxis = \"lt\"\n[pad_axes.clutch]\n";
  CHECK(begins(refusal(throttle + "axis = \"lt\"\n"), "my.toml:4: axis = \"lt\": is already bound to clutch"));
  CHECK(refusal(throttle + "axis = \"lt\"\npad = 1\n") == "accepted");
  CHECK(refusal(throttle + "axis = 4\nstick = \"Pedals\"\n") == "accepted");
}

TEST_CASE("throttle and brake may be the two halves of one axis, but must not overlap") {
  const std::string throttle =
      stop + "[pad_axes.brake]\naxis = \"lt\"\nfrom = 0\nto = 1\n[pad_axes.throttle]\naxis = \"lt\"\n";
  CHECK(refusal(throttle + "from = 0\nto = -1\n") == "accepted");
  CHECK(begins(refusal(throttle + "from = 0.1\nto = -1\n"), "my.toml:8: axis = \"lt\": is already bound to brake"));
  // Measured rests may differ by a count; the dead zone has room for it.
  CHECK(refusal(throttle + "from = 0.004\nto = -1\ndead_zone = 0.02\n") == "accepted");
}

TEST_CASE("controllers that are absent, renamed, unreadable, too small or not set up are named in a sentence") {
  const Bindings bindings = bindings_of(stop +
                                        "[[controller]]\nstick = \"Base\"\narm = \"3\"\ngear_1 = \"113\"\n"
                                        "[pad_axes.throttle]\nstick = \"Pedals\"\nid = \"30b7:1003\"\naxis = 0\n"
                                        "[pad_axes.brake]\nstick = \"Pedals\"\nid = \"30b7:1003\"\naxis = 1\n");
  const Controller pad = gamepad({}), wheel = controller("Wheel", {0.0f}), pedals = controller("Acme Pedals", {0.0f});
  const Controller base = controller("Gudsen R9 Base", {0.0f}, 128), old = controller("Gudsen R9 Base", {0.0f}, 80);
  Controller renamed = controller("Foot controls", {0.0f}, 0, "30b7:1003"), closed = pedals;
  closed.can_be_read = false;
  using Sentences = std::vector<std::string>;
  const auto described = [&](const std::vector<Controller>& all) {
    Sentences sentences = describe_bound(bindings, all), others = describe_unbound(bindings, all);
    sentences.insert(sentences.end(), others.begin(), others.end());
    return sentences;
  };
  CHECK(described({pad, pedals, base}).empty());
  CHECK(described({pad, wheel, base}) ==
        Sentences{"Pedals is not plugged in, so these have no effect: brake, throttle. Plug it in, or set up another "
                  "controller.",
                  "Wheel was found. It has no effect until you set it up, here or by: gearshift devices --controls"});
  CHECK(described({renamed, base}) ==
        Sentences{
            "Pedals is called Foot controls today. If its pedals or buttons have changed places, set it up again."});
  CHECK(described({closed, base}) ==
        Sentences{"This user may not read Acme Pedals. \"gearshift devices\" shows how to allow it."});
  CHECK(
      described({pedals, old}) ==
      Sentences{"Gudsen R9 Base reports 80 buttons, so its button 113 has no effect. Linux before 6.15 reports at most "
                "80; a shifter on its own USB cable has fewer."});
}

TEST_CASE("the buttons of several controllers, their gears included, are read as written") {
  const Bindings bindings =
      bindings_of(stop +
                  "[[controller]]\nstick = \"Shifter\"\nid = \"0eb7:1a92\"\ngear_reverse = \"0\"\ngear_1 = \"1, 527\"\n"
                  "[[controller]]\nstick = \"Box\"\nshift_up = \"1\"\nhand_brake_hold = \"2\"\ngear_neutral = \"3\"\n");
  REQUIRE(bindings.controllers.size() == 2);
  CHECK(bindings.controllers[0].of == ControllerName{"Shifter", "0eb7:1a92"});
  CHECK(bindings.controllers[0].gears == std::map<int, std::vector<int>>{{kReverseGear, {0}}, {1, {1, 527}}});
  CHECK(bindings.controllers[1].actions ==
        std::map<Action, std::vector<int>>{{Action::shift_up, {1}}, {Action::hand_brake_hold, {2}}});
  CHECK(bindings.controllers[1].gears == std::map<int, std::vector<int>>{{kNeutralGear, {3}}});
  const std::string help = help_text(bindings, {});
  CHECK(help.find("Shifter button 1, Shifter button 527\tgear 1\n") != std::string::npos);
  CHECK(help.find("Shifter button 0\tgear R\n") != std::string::npos);
  CHECK(help.find("Box button 3\tneutral\n") != std::string::npos);
}

TEST_CASE("stick names, a lever's rest, both dead zones and the lever mode are read as written") {
  const Bindings bindings = bindings_of(
      stop +
      "[[controller]]\nstick = \"Wheel\"\narm = \"3\"\n"
      "[pad_axes.lever_select]\nstick = \"T.16000M\"\naxis = 0\ncentre = 0.1\ndead_zone = 0.1\nend_zone = 0.05\n"
      "[lever]\nmode = \"places\"\nfull_speed_m_per_s = 0.5\n");
  REQUIRE(bindings.lever_select);
  CHECK(bindings.lever_select->of.stick == "T.16000M");
  CHECK(bindings.lever_select->centre == 0.1);
  CHECK(bindings.lever_select->end_zone == 0.05);
  CHECK(bindings.lever.mode == LeverMode::places);
  CHECK(bindings.lever.speed == 0.5);
  CHECK(bindings_of(stop).lever.mode == LeverMode::moves);
  CHECK(help_text(bindings, {}).find("T.16000M axis 0\tmove the lever sideways\n") != std::string::npos);
  CHECK(help_text(bindings, {}).find("Wheel button 3\tturn forces on") != std::string::npos);
  const std::string axis = stop + "[pad_axes.lever_select]\naxis = \"left_x\"\n";
  CHECK(begins(refusal(axis + "centre = 0.95\n"),
               "my.toml:5: centre = 0.95: must lie well between \"from\" (-1) and \"to\" (1)"));
  CHECK(begins(refusal(axis + "dead_zone = 0.5\nend_zone = 0.6\n"),
               "my.toml:6: end_zone = 0.6: the sum of end_zone and dead_zone (0.5) must not exceed 0.95"));
  CHECK(
      begins(refusal(stop + "[pad_axes.clutch]\naxis = \"lt\"\ncentre = 0\n"), "my.toml:5: centre is not a known key"));
  CHECK(begins(refusal(stop + "[lever]\nmode = \"jumps\"\n"), "my.toml:4: mode = \"jumps\": must be"));
  CHECK(begins(refusal(stop + "[lever]\nfull_speed_m_per_s = 3\n"), "my.toml:4: full_speed_m_per_s = 3: must be"));
}

TEST_CASE("the shipped bindings include a pad's stop button") {
  CHECK(read_bindings(shipped).pad_buttons.contains(Action::stop));
}

TEST_CASE("bindings that are written and read again are equal: the shipped ones and complete ones") {
  Bindings full = read_bindings(shipped);
  full.controllers = {
      {{"a \"quoted\" \\ stick", "1234:abcd"}, 1, {{Action::arm, {3, 12}}}, {{kReverseGear, {0}}, {1, {1}}}},
      {{"Another", ""}, 0, {}, {}}};
  full.lever_select->of = {"Stick", "046d:c24f"};
  full.lever_select->centre = 0.1234567890123456;
  full.lever_select->end_zone = 1.0 / 3.0;
  full.lever.mode = LeverMode::steps;
  full.lever.speed = 0.1;
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
    REQUIRE(back.controllers.size() == bindings.controllers.size());
    for (std::size_t i = 0; i < back.controllers.size(); ++i) {
      CHECK(back.controllers[i].of == bindings.controllers[i].of);
      CHECK(back.controllers[i].which == bindings.controllers[i].which);
      CHECK(back.controllers[i].actions == bindings.controllers[i].actions);
      CHECK(back.controllers[i].gears == bindings.controllers[i].gears);
    }
    REQUIRE(back.lever_select);
    CHECK(back.lever_select->of == bindings.lever_select->of);
    CHECK(back.lever_select->centre == bindings.lever_select->centre);
    CHECK(back.lever_select->end_zone == bindings.lever_select->end_zone);
    CHECK(back.lever_shift->from == bindings.lever_shift->from);
    CHECK(back.lever.mode == bindings.lever.mode);
    CHECK(back.lever.speed == bindings.lever.speed);
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
  const std::string help = help_text(bindings, {});
  CHECK(help.find("F11\tswitch between full screen and window\n") != std::string::npos);
  CHECK(help.find("Space, F12\tstop (turn forces off)\n") != std::string::npos);
  CHECK(help.find("Pad RT\tthrottle\n") != std::string::npos);
  CHECK(help_text({}, {}).find("F1\t") == std::string::npos);
  Controller sony = gamepad({});
  sony.id = "054c:0ce6";
  CHECK(help_text(bindings, {sony}).find("Pad R2\tthrottle\n") != std::string::npos);
  CHECK(help_text(bindings, {sony}).find("Pad Circle\tstop (turn forces off)\n") != std::string::npos);
  CHECK(help_text(bindings, {gamepad({})}).find("Pad B\tstop (turn forces off)\n") != std::string::npos);
  for (const auto& [id, label] : {std::pair{"054c:0ce6", "Create"},
                                  {"054c:0df2", "Create"},
                                  {"054c:09cc", "Share"},
                                  {"054c:05c4", "Share"},
                                  {"054c:0ba0", "Share"},
                                  {"054c:0268", "Select"}}) {
    sony.id = id;
    CHECK(help_text(bindings, {sony}).find("Pad " + std::string(label) + "\tnext camera\n") != std::string::npos);
  }
  CHECK(std::count(help.begin(), help.end(), '\t') == std::count(help.begin(), help.end(), '\n'));
}
