// Moves the hand to a gear that the driver has selected by a button: the buttons of a shifter, which are held as long
// as its own lever is in a gear, or the buttons for one gear up and down. In the gear the hand follows the lever,
// without a push.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate.h"

namespace gearshift::ui {

class GearHand {
 public:
  void set_gate(const haptics::Gate& gate);

  // Begins to move from the lever point `lever` [m] to the gear, and presses the knob or lifts the ring on the way if
  // the gate requires it. Does nothing before set_gate(). `engaged`: the engaged gear.
  void shift_to(int gear, int engaged, glm::dvec2 lever) { shift(gear, engaged, lever, true); }
  // Like shift_to(), for the gear that follows the engaged one in the order R N 1 2 3 ... In a sequential gate, the
  // driver opens the lockouts.
  void shift_by(int gears, int engaged, glm::dvec2 lever);
  void try_again(int engaged, glm::dvec2 lever);  // does nothing where the driver has to open a lockout
  void release() noexcept { hand_.reset(); }      // something else moves the hand

  bool is_active() const noexcept { return hand_.has_value(); }
  // Call once per frame while active. At the end of each stroke the hand waits for the lever: with few frames per second
  // it would otherwise cut the corner into another gear.
  // `engaged`: the engaged gear. If the gear is not engaged in time, the hand gives up:
  // it no longer pushes.
  haptics::HandTarget next(double seconds, glm::dvec2 lever, int engaged);
  bool is_moving() const;  // the lever may still arrive in the selected gear
  int selected_gear() const noexcept { return gear_; }

 private:
  void shift(int gear, int engaged, glm::dvec2 lever, bool opens_lockouts);

  std::optional<haptics::Gate> gate_;
  std::optional<haptics::ScriptedHand> hand_;
  int gear_ = haptics::kNeutralGear;  // selected
  double time_ = 0.0;                 // [s] since shift_to()
  bool opens_lockouts_ = true;
  bool is_resting_ = false;  // the lever has arrived
  struct Corner {
    double end = 0.0;  // [s] time of the stroke's end
    glm::dvec2 at{0.0};
  };
  std::vector<Corner> corners_;  // ends of the strokes that have not ended
  double waited_ = 0.0;          // [s] at the first of them
};

}  // namespace gearshift::ui
