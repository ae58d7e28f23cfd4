// The keys, buttons and pedals in the panel's texts: legend, prompts, answers to what came too early.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/ui/panel/panel.h"

namespace gearshift::ui {

void draw_keys(std::span<const KeyHint> keys);  // draws key caps with their actions, in as many lines as needed

// Names what moves a control behind its first mention: "Press the clutch (A) all the way down."
std::string name_inputs(std::string_view text, std::span<const KeyHint> keys);

struct EarlyInput {
  bool starter = false, shifts = false, throttle = false;  // the driver tries to
};
// Answers an input that can have no effect yet: "Ignition first: I." Empty if it is in time, or if there is no car.
std::string early_reply(const EarlyInput& input, const vehicle::VehicleState& car, std::span<const KeyHint> keys);

// Shows how to restart a stalled engine; names the starter key if one is bound.
void draw_restart_prompt(std::span<const KeyHint> keys);

// Returns a prompt that says what the mouse controls and how to change that.
const char* mouse_prompt(bool mouse_moves_lever, bool panel_shown);

}  // namespace gearshift::ui
