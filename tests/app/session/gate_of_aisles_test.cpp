// A gate of aisles in the trainer: without a car, by every way to choose it.
#include <algorithm>
#include <stdexcept>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/session/resolve_choice.h"
#include "app/session/session.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift;
using namespace gearshift::session;
using namespace gearshift::test;

TEST_CASE("a gate of aisles is offered and needs no car; a lesson gets the car's gate and says why") {
  SessionChoice choice;
  choice.gate = "crane_cross";
  CHECK(resolve_car(choice).car == kNoCar);
  choice.gate.clear();
  choice.car = "hatchback";
  const SessionChoice changed = with_gate(choice, "selector_p_r_n_d");
  CHECK(changed.car == kNoCar);
  const lessons::Lesson lesson = lessons::read_lesson(GEARSHIFT_ASSETS "/lessons/moving_off.toml");
  const SessionChoice taught = with_lesson(changed, lesson);
  CHECK(taught.gate == "five_speed_r_right_down");
  CHECK(describe_replaced_gate(changed, taught, lesson) ==
        "This lesson needs a slot for each gear, so the gate is five_speed_r_right_down instead of selector_p_r_n_d.");
}

TEST_CASE("the trainer moves the lever through a gate of aisles, and refuses a car in it") {
  const TempFolder folder;
  const Variable config("XDG_CONFIG_HOME", folder.path().c_str()), data("XDG_DATA_HOME", folder.path().c_str());
  SessionChoice choice;
  choice.lesson = "none";
  choice.gate = "selector_p_r_n_d";
  choice.hand = "grip";
  choice.clock = runtime::RuntimeClock::virtual_time;
  choice.sound = engine::SoundOutput::none;
  {
    Session session(choice);
    const auto& gates = session.panel_input().gates;
    CHECK(std::count(gates.begin(), gates.end(), "crane_cross") == 1);
    haptics::HandTarget hand;
    hand.position = haptics::rest_position(session.runtime().gate(), haptics::kNeutralGear);
    for (int i = 0; i < 200; ++i) {  // from N to D, 26 mm back
      hand.position.y = std::max(-0.010, hand.position.y - 0.0004);
      session.runtime().set_hand(hand);
      session.advance(0.01);
    }
    CHECK(std::string(haptics::gear_label(session.runtime().gate(), session.runtime().snapshot().gear)) == "D");
  }
  // P is entered with the knob pressed, and left only with a foot on the brake: a key or an axis.
  for (const bool by_key : {true, false}) {
    CAPTURE(by_key);
    Session session(choice);
    const haptics::Gate& gate = session.runtime().gate();
    const auto gear = [&] { return std::string(haptics::gear_label(gate, session.runtime().snapshot().gear)); };
    haptics::HandTarget hand;
    haptics::DriverControls controls;
    haptics::PedalKeys keys;
    hand.position = haptics::rest_position(gate, haptics::kNeutralGear);
    hand.pressed_down = true;
    const auto go = [&](glm::dvec2 to) {
      for (int i = 0; i < 200; ++i) {
        const glm::dvec2 way = to - hand.position;
        hand.position += way * std::min(1.0, 0.0004 / std::max(1e-9, glm::length(way)));
        session.lever().set_driver(hand, controls, keys);
        session.advance(0.01);
      }
    };
    const glm::dvec2 in_r{-0.026, 0.016}, in_p{-0.026, 0.045};
    go(in_r);
    CHECK(gear() == "R");
    go(in_p);
    CHECK(gear() == "P");
    go(in_r);
    CHECK(gear() == "P");
    keys.brake = by_key;
    controls.pedals.brake = by_key ? 0.0 : 0.5;
    go(in_r);
    CHECK(gear() == "R");
  }
  choice.car = "hatchback";
  CHECK_THROWS_WITH_AS(Session{choice}, "a gate of aisles works without a car, not with \"hatchback\"",
                       std::invalid_argument);
}
