// Scripts of `gearshift drive`: both kinds of file, values between rows, and the sentence for each kind of bad input.
#include "app/lab/drive/drive_script.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "app/lab/drive/scripted_drive.h"
#include "haptics/files/file_error.h"
#include "tests/support/gates.h"

using namespace gearshift;
using namespace gearshift::lab;
using doctest::Approx;

namespace {

// The sentence with which a text is refused; empty if it is accepted.
std::string refusal(const std::string& text, const std::string& file = "bad.csv") {
  try {
    parse_drive_script(text, file);
  } catch (const haptics::FileError& error) {
    return error.what();
  }
  return {};
}

std::string start_refusal(const std::string& text) {
  try {
    parse_drive_start(text, 0);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("numbers are linear between rows, gears and switches change at their row") {
  const DriveScript script = parse_drive_script(
      "# a comment\r\ntime_s, throttle, clutch, slope_percent, gear, starter\r\n\r\n0,0,1,0,1,0\r\n2, "
      "0.5,1,-8,,1\r\n4,1,0,-8,\"2\",0\r\n",
      "a.csv");
  CHECK(script.end() == 4.0);
  ScriptPlayer player(script);
  CHECK(player.at(0.0).controls.pedals.throttle == 0.0);
  CHECK(player.at(0.0).controls.ignition);
  ScriptRow row = player.at(1.0);
  CHECK(row.controls.pedals.throttle == Approx(0.25));
  CHECK(row.controls.pedals.clutch == 1.0);
  CHECK(std::tan(row.controls.slope) == Approx(-0.04));
  CHECK(row.gear == 1);
  CHECK_FALSE(row.controls.starter);
  row = player.at(3.0);
  CHECK(row.controls.pedals.throttle == Approx(0.75));
  CHECK(row.controls.pedals.clutch == Approx(0.5));
  CHECK(row.gear == 1);  // the empty field is that of the row before
  CHECK(row.controls.starter);
  CHECK(player.at(4.0).gear == 2);
  CHECK(player.at(9.0).controls.pedals.throttle == 1.0);
}

TEST_CASE("two rows at one time are a step, and a first row after 0 holds before its time") {
  const DriveScript script = parse_drive_script("time_s,clutch\n1,1\n1.5,1\n1.5,0\n2,0\n", "a.csv");
  ScriptPlayer player(script);
  CHECK(player.at(0.0).controls.pedals.clutch == 1.0);
  CHECK(player.at(1.499).controls.pedals.clutch == 1.0);
  CHECK(player.at(1.5).controls.pedals.clutch == 0.0);
}

TEST_CASE("TOML gives the same script as CSV, and the lever can be led instead of a gear") {
  const DriveScript toml = parse_drive_script(
      "[[row]]\ntime_s = 0\nclutch = 1\nlever_x_mm = -10\n[[row]]\ntime_s = 2\nlever_y_mm = 20\n", "a.toml");
  const DriveScript csv = parse_drive_script("time_s,clutch,lever_x_mm,lever_y_mm\n0,1,-10,\n2,,,20\n", "a.csv");
  for (const DriveScript* script : {&toml, &csv}) {
    ScriptPlayer player(*script);
    const ScriptRow row = player.at(1.0);
    CHECK(row.controls.pedals.clutch == 1.0);
    REQUIRE(row.lever);
    CHECK(row.lever->x == Approx(-0.010));
    CHECK(row.lever->y == Approx(0.010));
  }
}

TEST_CASE("bad input gets one sentence with file, line, key, value and range") {
  CHECK(refusal("time_s,throttle\n0,0\n1,1.5\n") == "bad.csv:3: throttle = 1.5: must be between 0 and 1");
  CHECK(refusal("time_s,throttle\n0,x\n") == "bad.csv:2: throttle = x: must be a number between 0 and 1");
  CHECK(refusal("time_s,brake\n0,nan\n") == "bad.csv:2: brake = nan: must be between 0 and 1");
  CHECK(refusal("time_s,brake\n2,0\n1,0\n") == "bad.csv:3: time_s = 1: must be at least that of the row before, 2");
  CHECK(refusal("time_s,brake\n,0\n") == "bad.csv:2: time_s = \"\": must be a number between 0 and 1800");
  CHECK(refusal("time_s,gear\n0,seven\n").starts_with("bad.csv:2: gear = seven: must be one of R, N, 1, 2"));
  CHECK(refusal("time_s,starter\n0,0.5\n") == "bad.csv:2: starter = 0.5: must be 0 or 1");
  CHECK(refusal("time_s,gear,lever_x_mm\n0,1,3\n") == "bad.csv:2: lever_x_mm = 3: cannot be combined with gear");
  CHECK(refusal("time_s,speed\n0,1\n")
            .starts_with("bad.csv:1: \"speed\" is not a known column; known: time_s, throttle"));
  CHECK(refusal("time_s,brake,brake\n0,1,1\n") == "bad.csv:1: brake is there twice");
  CHECK(refusal("throttle\n0\n") == "bad.csv:1: the column time_s is missing");
  CHECK(refusal("time_s,gear\n0,\"1\n") == "bad.csv:2: a double quote is not closed");
  CHECK(refusal("time_s,brake\n0\n") == "bad.csv:2: has 1 values, but there are 2 columns");
  CHECK(refusal("time_s\n").starts_with("bad.csv: has no rows"));
  CHECK(refusal("", "bad.toml") == "bad.toml: has no [[row]]");
  CHECK(refusal("[[row]]\nthrottle = 1\n", "bad.toml").find("time_s is missing") != std::string::npos);
  CHECK(refusal("[[row]]\ntime_s = 1\nclutch = 2\n", "bad.toml") == "bad.toml:3: clutch = 2: must be between 0 and 1");
  CHECK(refusal("[[row]]\ntime_s = 1\npedal = 2\n", "bad.toml").find("pedal is not a known key") != std::string::npos);
}

TEST_CASE("a script asks only for gears that the gate has") {
  const DriveScript script = parse_drive_script("time_s,gear\n0,N\n1.5,6\n", "a.csv");
  check_script_fits(script, test::shipped_gate("six_speed_r_left_down"));
  CHECK_THROWS_WITH(check_script_fits(script, test::shipped_gate("five_speed_r_right_down")),
                    "a.csv: gear = 6 at 1.5 s: this gate has no such gear");
}

TEST_CASE("a start is a list, and what it leaves out is the first row's") {
  const vehicle::CarStart start = parse_drive_start("gear=2,speed_km_per_h=36,engine=off", 1);
  CHECK(start.gear == 2);
  CHECK(start.road_speed == Approx(10.0));
  CHECK_FALSE(start.running);
  CHECK(parse_drive_start("", 1).gear == 1);
  CHECK(parse_drive_start("", 1).running);
  CHECK(start_refusal("gear=x") == "gear = x: must be a gear as the gate names it, such as R, N or 1");
  CHECK(start_refusal("speed_km_per_h=fast") == "speed_km_per_h = fast: must be a number between -250 and 250");
  CHECK(start_refusal("engine=maybe") == "engine = maybe: must be on or off");
  CHECK(start_refusal("speed=3").starts_with("\"speed=3\" is not known: write gear=GEAR"));
}
