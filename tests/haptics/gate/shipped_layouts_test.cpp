// The gates that come with the program: what each must be, and that they fit the paper's joystick.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>

#include <doctest/doctest.h>

#include "haptics/gate/gate_compiler.h"
#include "tests/support/gates.h"

using namespace gearshift;
using doctest::Approx;
using glm::dvec2;

namespace {

// A gate as it is engraved on a knob: the forward row, the back row, '-' where there is no gear.
struct Knob {
  const char* name;
  const char* forward;
  const char* back;
  int lateral;  // lockouts across the neutral aisle
  int mouth;    // lockouts in the mouth of a slot
};

constexpr Knob kKnobs[] = {
    {"paper", "135", "24R", 0, 0},
    {"five_speed_r_left_up", "R135", "-24-", 2, 0},
    {"five_speed_r_right_down", "135", "24R", 0, 2},
    {"six_speed_r_left_up", "R135", "-246", 2, 0},
    {"six_speed_r_left_down", "-135", "R246", 2, 0},
    {"six_speed_r_right_down", "135-", "246R", 1, 0},
    {"dog_leg_five", "R24", "135", 0, 2},
    {"four_speed", "-13", "R24", 2, 0},
};

std::string row(const Gate& gate, Side side) {
  std::string gears;
  for (int i = 0; i < gate.column_count; ++i) {
    const Column& column = gate.column[static_cast<std::size_t>(i)];
    const int slot = side == Side::forward ? column.forward_slot : column.back_slot;
    gears += slot == kNoSlot ? "-" : gear_name(gate.slot[static_cast<std::size_t>(slot)].gear);
  }
  return gears;
}

// Eq (2) corrected: px = rho tan(theta) / s, py = -rho tan(phi) / s, pz = rho / s with
// s = sqrt(1 + tan^2 theta + tan^2 phi). A point of the gate plane is reached if both angles stay inside
// their stops.
bool reaches(dvec2 point) {
  constexpr double rho = 0.120;
  const double height = std::sqrt(rho * rho - point.x * point.x - point.y * point.y);
  const double theta = std::atan2(std::abs(point.x), height) * 180.0 / std::numbers::pi;
  const double phi = std::atan2(std::abs(point.y), height) * 180.0 / std::numbers::pi;
  return theta < 40.0 && phi < 35.0;
}

}  // namespace

TEST_CASE("every shipped gate has the gears where a driver expects them") {
  for (const Knob& knob : kKnobs) {
    CAPTURE(knob.name);
    const Gate gate = shipped_gate(knob.name);
    CHECK(row(gate, Side::forward) == knob.forward);
    CHECK(row(gate, Side::back) == knob.back);
    int lateral = 0;
    for (int i = 0; i < gate.lockout_count; ++i) lateral += gate.lockout[static_cast<std::size_t>(i)].lateral;
    CHECK(lateral == knob.lateral);
    CHECK(gate.lockout_count - lateral == knob.mouth);
  }
}

TEST_CASE("no gate is shipped without being listed") {
  std::set<std::string> expected, found;
  for (const Knob& knob : kKnobs) expected.insert(knob.name);
  for (const auto& entry : std::filesystem::directory_iterator(GEARSHIFT_ASSETS "/gates")) {
    if (entry.path().extension() == ".toml") found.insert(entry.path().stem().string());
  }
  CHECK(found == expected);
  const auto names = shipped_names();
  CHECK(std::set<std::string>(names.begin(), names.end()) == expected);
}

TEST_CASE("every corner of every shipped gate is inside the exact workspace, pressed 6.3 mm into its walls") {
  for (const Knob& knob : kKnobs) {
    CAPTURE(knob.name);
    const Gate gate = shipped_gate(knob.name);
    for (int i = 0; i < gate.slot_count; ++i) {
      const Slot& slot = gate.slot[static_cast<std::size_t>(i)];
      const Column& column = gate.column[static_cast<std::size_t>(slot.column)];
      const double x = std::abs(column.center) + column.half_width;
      CHECK(reaches({x + 0.0063, slot.end}));
      CHECK(reaches({x, slot.end + 0.0063}));
    }
  }
}

TEST_CASE("no force of a shipped gate comes near the clamp of 31.7 N") {
  for (const Knob& knob : kKnobs) {
    CAPTURE(knob.name);
    const GateLayout layout = read_gate_layout(GEARSHIFT_ASSETS "/gates/" + std::string(knob.name) + ".toml");
    CHECK(layout.feel.lock_force + layout.feel.center_force <= 16.0);
    CHECK(layout.feel.detent_force < layout.feel.lock_force);
  }
}

TEST_CASE("every shipped lockout of speed closes above 20 and opens below 15 km/h") {
  for (const Knob& knob : kKnobs) {
    CAPTURE(knob.name);
    const Gate gate = shipped_gate(knob.name);
    for (int i = 0; i < gate.lockout_count; ++i) {
      const Lockout& lockout = gate.lockout[static_cast<std::size_t>(i)];
      if (lockout.kind != LockoutKind::speed) continue;
      CHECK(lockout.close_above * 3.6 == Approx(20.0));
      CHECK(lockout.open_below * 3.6 == Approx(15.0));
      CHECK(gate.slot[static_cast<std::size_t>(lockout.slot)].gear == kReverseGear);
    }
  }
}

TEST_CASE("on the chamfers of every shipped gate the force along the slot does not depend on depth") {
  for (const Knob& knob : kKnobs) {
    CAPTURE(knob.name);
    const Gate gate = shipped_gate(knob.name);
    const double at_wall = feel_force(gate.aisle_feel, gate.half_aisle);
    for (int s = 0; s < gate.slot_count; ++s) {
      const FeelCurve& feel = gate.slot[static_cast<std::size_t>(s)].feel;
      for (int i = 0; i <= 400; ++i) {
        const double depth = gate.half_aisle + gate.chamfer * i / 400.0;
        CHECK(feel_slope(feel, depth) == Approx(0.0));
        CHECK(feel_force(feel, depth) == Approx(at_wall));
      }
    }
  }
}
