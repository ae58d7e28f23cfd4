// What a hand has to do to shift through gears of a gate: strokes for a ScriptedHand.
#pragma once

#include <span>
#include <vector>

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct ShiftStyle {
  double pace = 0.20;           // [m/s] mean speed of a stroke
  double reaction = 0.10;       // [s] added to every stroke
  double dwell_gear = 0.30;     // [s] in each gear
  double dwell_neutral = 0.05;  // [s] at each turn in the neutral aisle
  bool leans = true;            // aims 1.5 mm beyond end walls and end stops, as a hand does; else at the gear's rest
};

// Strokes from `start` [m] (in free space) through the gears in order, kNeutralGear included: out of the
// slot, along the neutral aisle (by way of the neutral column where a lockout demands it), into the slot. The
// knob is pushed down and lifted wherever a lockout on the way asks for it.
std::vector<HandStroke> shift_strokes(const Gate& gate, glm::dvec2 start, std::span<const int> gears,
                                      const ShiftStyle& style = {});

// The order of the paper's Fig. 9: forward gears rising, then reverse. All gears of the gate.
std::vector<int> tour_order(const Gate& gate);

// A hand's way to make up for the softness of its own impedance, stated once for tour, bench and tests.
ScriptedHandConfig touring_hand(glm::dvec2 start);

}  // namespace gearshift
