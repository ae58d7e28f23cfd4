// Plans the strokes with which a ScriptedHand shifts through the gears of a gate.
#pragma once

#include <span>
#include <vector>

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift::haptics {

struct ShiftStyle {
  double pace = 0.20;           // [m/s] mean speed of a stroke
  double reaction = 0.10;       // [s] added to the duration of every stroke
  double dwell_gear = 0.30;     // [s] dwell in each gear
  double dwell_neutral = 0.05;  // [s] dwell at each turn in the neutral aisle
  // true: the scripted hand aims 1.5 mm beyond end walls and end stops, as a human hand does; false: it aims at the
  // gear's rest position
  bool leans = true;
  int engaged = kNeutralGear;  // gear of a sequential gate at the start
  bool opens_lockouts = true;  // presses the knob or lifts the ring where a lockout requires it
};

// Strokes from `start` [m] (in free space) through the gears in order (kNeutralGear is allowed): out of the slot, along
// the neutral aisle (via the neutral column if a lockout requires it), into the slot. The knob is pushed down or lifted
// where a lockout requires it. In a sequential gate, one stroke and back for each gear on the way.
std::vector<HandStroke> shift_strokes(const Gate& gate, glm::dvec2 start, std::span<const int> gears,
                                      const ShiftStyle& style = {});

// All gears of the gate in the order of the paper's Fig. 9: forward gears rising, then reverse. In a sequential gate, the
// forward gears come again on the way down. In a mechanism of aisles: all places in the order of the file, and those on
// the way from one to the next.
std::vector<int> tour_order(const Gate& gate);

// Hand settings for the tour through all gears, the benchmarks and the tests. The effort compensates for the low
// stiffness of the hand.
ScriptedHandConfig touring_hand(glm::dvec2 start);

}  // namespace gearshift::haptics
