// The strip below the cabin in the learner's view: gate, pedals, gear, engine and speed, switches, and STOP.
#pragma once

#include <imgui.h>

#include "app/ui/panel/panel.h"
#include "haptics/gate/gate_description.h"

namespace gearshift::ui {

float learner_strip_height(ImVec2 screen);  // [px]; on narrow screens the strip has two rows

// The learner's choices in the strip.
struct LearnerChoice {
  bool lessons = false, engineer = false;
};
// Fills the current window. Pedals can be dragged, and a click in the gate sends the hand to a gear.
LearnerChoice draw_learner_strip(Controls& controls, const PanelInput& input, const haptics::GateDescription& gate,
                                 bool lists_lessons, PanelCommands& out);

// The range [1] in which the lesson's step wants the pedal; empty (`from` > `to`) if any position is right.
struct WantedRange {
  double from = 1.0, to = 0.0;
  bool is_set() const { return from <= to; }
};
WantedRange wanted_range(const PanelInput& input, double haptics::Pedals::*pedal);

}  // namespace gearshift::ui
