// Gates of straight aisles at any angle, and what H gates gained with them: springs per column, no centring, gears that
// are open only after others, labels.
#include <initializer_list>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/files/file_error.h"
#include "haptics/gate/gate_description.h"
#include "haptics/gate/gear_selector.h"
#include "haptics/gate/lockout.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using doctest::Approx;
using glm::dvec2;

namespace {

std::string aisle(double x0, double y0, double x1, double y1, const std::string& more = {}) {
  const auto key = [](const char* name, double value) {
    return std::string(name) + " = " + std::to_string(value) + "\n";
  };
  return "[[aisle]]\n" + key("from_x_mm", x0) + key("from_y_mm", y0) + key("to_x_mm", x1) + key("to_y_mm", y1) + more;
}

std::string place(const std::string& label, double x, double y, const std::string& more = {}) {
  return "[[place]]\nlabel = \"" + label + "\"\nx_mm = " + std::to_string(x) + "\ny_mm = " + std::to_string(y) + "\n" +
         more;
}

Gate compiled(const std::string& text) {
  return compile_gate(parse_gate_layout("name = \"Test\"\n" + text, "test.toml"), kPaperWorkspace);
}

std::string refusal(const std::string& text) {
  try {
    (void)compiled(text);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

const std::string kNeutralPlace = place("0", 0.0, 0.0, "neutral = true\n");
const std::string kTee = aisle(-30, 0, 30, 0) + aisle(0, 0, 0, 30) + kNeutralPlace;

}  // namespace

TEST_CASE("a gate of aisles that cannot be is refused with line and reason") {
  struct Refused {
    std::string text;
    const char* reason;
  };
  const Refused cases[] = {
      {kTee, "test.toml:12: a gate needs a place beside the neutral one"},
      {kTee + place("A", 30, 1), "place \"A\" at (30, 1) mm is on the centre line of no aisle"},
      {kTee + place("A", 30, 0) + place("A", -30, 0), "test.toml:21: place \"A\" is already in the file"},
      {kTee + place("A", 30, 0, "neutral = true\n"), "only one place can be neutral"},
      {kTee + place("A", 8, 0, "radius_mm = 12\n"),
       "place \"0\" needs a radius of 4 mm, but other places and aisles leave 0 mm"},
      {kTee + place("A", 30, 0, "lock_force_n = 20\n"), "feel like a wall"},
      {kTee + aisle(-31, 11, -20, 11) + place("A", 30, 0),
       "test.toml:17: this aisle and the aisle on line 2 are 11 mm apart; let their centre lines meet, or leave a wall "
       "of 2 "
       "mm between them: 12 mm"},
      {kTee + aisle(-30, 40, 0, 45) + place("A", 30, 0), "no way leads from the first aisle to this one"},
      {kTee + aisle(0, 0, 30, 10) + place("A", 30, 0), "must meet at an angle of at least 30 degrees"},
      {aisle(-30, 0, 80, 0) + kNeutralPlace + place("A", 30, 0), "is outside the workspace"},
      {aisle(-30, 0, 30, 0) + place("A", 30, 0), "no place is neutral"},
      {kTee + place("A", 30, 0) + "[[lockout]]\nplace = \"B\"\nkind = \"lift\"\n",
       "place = \"B\": must be one of 0, A"},
      {kTee + place("A", 30, 0) + "[[lockout]]\nplace = \"A\"\nkind = \"after_gear\"\n", "in a gate of aisles"},
      {"[feel]\ncenter_force_n = 0.2\n" + kTee + place("A", 30, 0),
       "or the lever would not return to the neutral place"},
      {"[feel]\nlock_force_n = 5\n" + kTee + place("A", 30, 0), "lock_force_n is not a known key"},
      {"[gate]\nslot_width_mm = 8\n" + kTee + place("A", 30, 0),
       "must be left out, because [[aisle]] describes the gate"},
      {aisle(0, -30, 0, 30, "width_mm = 14\n") + aisle(-6, 0, 6, 0, "spring_n = 3\n") +
           place("0", 0, 30, "neutral = true\n") + place("A", 0, -30),
       "spring_n would have no effect"},
      {"[[aisle]]\nfrom_x_mm = 1\n", "from_y_mm is missing"},
      // Round a loop of four aisles, a spring in one of them would drive the lever for ever.
      {aisle(-20, -20, 20, -20, "spring_n = 3\n") + aisle(20, -20, 20, 20) + aisle(20, 20, -20, 20) +
           aisle(-20, 20, -20, -20) + place("0", 20, 20, "neutral = true\n") + place("A", -20, 20),
       "the springs would drive the lever round a loop of aisles for ever"},
  };
  for (const Refused& refused : cases) {
    const std::string said = refusal(refused.text);
    CAPTURE(said);
    CHECK(said.find(refused.reason) != std::string::npos);
  }
  CHECK(refusal(kTee + place("A", 30, 0)) == "accepted");
}

// Springs that pull to the same corner along both ways round a rectangle do the same work along each, so it is a potential.
TEST_CASE("springs round a loop are accepted if their work round it is zero") {
  const std::string spring = "spring_n = 3\n";
  CHECK(refusal(aisle(-20, -20, 20, -20, spring) + aisle(20, -20, 20, 20) + aisle(20, 20, -20, 20) +
                aisle(-20, -20, -20, 20) + place("0", 20, 20, "neutral = true\n") + place("A", -20, 20)) != "accepted");
  CHECK(refusal(aisle(-20, -20, 20, -20, spring) + aisle(20, -20, 20, 20) + aisle(-20, 20, 20, 20, spring) +
                aisle(-20, -20, -20, 20) + place("0", 20, 20, "neutral = true\n") + place("A", -20, 20)) == "accepted");
}

TEST_CASE("a tee has one junction with a closed side, three wall pairs, and walls that follow its outline") {
  const Gate gate = compiled(kTee + place("A", 30, 0));
  const GateDescription list = describe_gate(gate);
  REQUIRE(list.junctions.size() == 1);
  const JunctionInfo& junction = list.junctions[0];
  CHECK(junction.left);
  CHECK(junction.right);
  CHECK(junction.forward);
  CHECK_FALSE(junction.back);
  CHECK(list.wall_pairs.size() == 3);
  double closed = 0.0;
  for (const WallInfo& wall : list.walls) {
    if (wall.role == WallRole::closed_side) closed += glm::distance(wall.from, wall.to);
    const dvec2 middle = 0.5 * (wall.from + wall.to);  // every wall lies on the outline: free space ends there
    CHECK(in_free_space(gate, middle, 1e-9));
    CHECK_FALSE(in_free_space(gate, middle, -1e-3));
  }
  CHECK(closed == Approx(0.010));  // opposite the stem, as wide as it
}

TEST_CASE("a place counts within 0.8 of its radius and is released beyond 0.9 of it") {
  const Gate gate = compiled(kTee + place("A", 30, 0, "radius_mm = 10\n"));
  const int position = slot_of(gate, 1).gear;
  CHECK(std::string(gear_label(gate, position)) == "A");
  CHECK(rest_position(gate, position) == dvec2(0.030, 0.0));
  GearSelector selector(0.0);
  const auto at = [&](double off) {
    for (int i = 0; i < 3; ++i) (void)selector.update(gate, {0.030 - off, 0.0}, 0.001);
    return selector.gear();
  };
  CHECK(at(0.0081) == kNeutralGear);
  CHECK(at(0.0079) == position);
  CHECK(at(0.0089) == position);
  CHECK(at(0.0091) == kNeutralGear);
}

TEST_CASE("the spring of an aisle pulls to its point with the force of the file, and not where aisles meet") {
  const Gate gate = compiled(aisle(-30, 0, 30, 0, "spring_n = 4\nspring_to_mm = 30\n") + aisle(0, 0, 0, 30) +
                             kNeutralPlace + place("A", 30, 0, "lock_force_n = 0\n"));
  CHECK(gate_feel(gate, {0.018, 0.0}).x == Approx(-4.0));
  CHECK(gate_feel(gate, {-0.018, 0.0}).x == Approx(4.0));
  CHECK(gate_feel(gate, {0.034, 0.0}).x == Approx(-4.0));  // in the round end, too
  CHECK(glm::length(gate_feel(gate, {0.0, 0.020})) == 0.0);
}

TEST_CASE("in a cross gate the return force points to the middle from everywhere") {
  const Gate gate = shipped_gate("crane_cross");
  for (const dvec2 p : {dvec2{0.013, 0.0}, {-0.013, 0.0}, {0.0, 0.013}, {0.0, -0.013}, {0.0128, 0.002}}) {
    const dvec2 force = gate_feel(gate, p);
    CHECK(glm::length(force) == Approx(4.0));
    CHECK(glm::dot(force, p) == Approx(-4.0 * glm::length(p)));
  }
}

TEST_CASE("the selector's P is left only with the brake pressed, and R entered with the button") {
  const Gate gate = shipped_gate("selector_p_r_n_d");
  const dvec2 in_p{-0.026, 0.045}, between{-0.026, 0.030}, in_r{-0.026, 0.016};
  Lockouts lockouts;
  LockoutInputs in;
  in.gear = slot_of(gate, 0).gear;
  CHECK(lockouts.update(gate, in, in_p).held_slot == 0);
  Passage passage = lockouts.update(gate, in, between);
  CHECK((passage.closed & 1u) != 0);                          // P
  CHECK((passage.closed & 2u) != 0);                          // R
  CHECK((lockouts.update(gate, in, in_r).closed & 2u) == 0);  // a lever in R is not in its way
  in.pressed_down = true;
  CHECK(lockouts.update(gate, in, in_p).held_slot == 0);
  CHECK(lockouts.update(gate, in, between).closed == 0);
  in.brake = 0.09;
  CHECK(lockouts.update(gate, in, in_p).held_slot == 0);
  in.brake = 0.1;
  CHECK(lockouts.update(gate, in, in_p).held_slot == kNoSlot);
}

TEST_CASE("reverse lies behind a spring of its own, and the force between the columns rises without a jump") {
  const Gate gate = shipped_gate("six_speed_r_left_spring");
  CHECK(feel_force(gate.select_feel, -0.025) == Approx(3.0));
  CHECK(feel_force(gate.select_feel, -0.054) == Approx(8.0));
  CHECK(feel_force(gate.select_feel, -0.100) == Approx(8.0));
  CHECK(feel_force(gate.select_feel, 0.025) == Approx(-3.0));
  for (double x = -0.054; x < -0.025; x += 1e-4)
    CHECK(feel_force(gate.select_feel, x) >= feel_force(gate.select_feel, x + 1e-4) - 1e-12);
}

TEST_CASE("seventh opens only after fifth or sixth, also after a pause in neutral, and closes after any other gear") {
  const Gate gate = shipped_gate("seven_speed");
  const dvec2 neutral{0.0, 0.0};
  Lockouts lockouts;
  const auto is_open_after = [&](std::initializer_list<int> gears) {
    bool is_open = false;
    for (const int gear : gears) {
      LockoutInputs in;
      in.gear = gear;
      is_open = lockouts.update(gate, in, neutral).select_max == gate.select_max;
    }
    return is_open;
  };
  CHECK_FALSE(is_open_after({kNeutralGear}));
  CHECK_FALSE(is_open_after({3, kNeutralGear}));
  CHECK(is_open_after({5, kNeutralGear}));
  CHECK(is_open_after({kNeutralGear, 7, kNeutralGear}));
  CHECK_FALSE(is_open_after({4, kNeutralGear}));
  CHECK(is_open_after({6}));
}

TEST_CASE("18 gears and reverse fit in ten columns, and a label replaces a gear's name") {
  std::string text =
      "[gate]\nslot_width_mm = 4\nchamfer_mm = 1\nslot_length_mm = 30\naisle_width_mm = 8\n[feel]\n"
      "lock_force_n = 6\ndetent_force_n = 3\nmouth_force_n = 1\ncenter_force_n = 2\nbuffer_force_n = 0\n";
  for (int i = 0; i < 10; ++i) {
    text += "[[column]]\nposition_mm = " + std::to_string(-54 + 12 * i) + "\nforward = \"" +
            (i == 9 ? "R" : std::to_string(2 * i + 1)) + "\"\n";
    if (i < 9) text += "back = \"" + std::to_string(2 * i + 2) + "\"\n";
    if (i == 0) text += "forward_label = \"L\"\n";
    if (i == 5) text += "neutral = true\n";
  }
  const Gate gate = compiled(text);
  CHECK(gate.slot_count == 19);
  CHECK(std::string(gear_label(gate, 1)) == "L");
  CHECK(std::string(gear_label(gate, 18)) == "18");
  CHECK(has_gear(gate, 18));
}
