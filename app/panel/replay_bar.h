// A recorded drive that is looked at again: its shifts, its curves, where it stands, how fast it goes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/panel/panel.h"
#include "app/panel/strip.h"

namespace gearshift {

class ReplayBar {
 public:
  // Along the lower edge of that room [px]; returns its upper edge: the room's lower one where there is no replay.
  double draw(Controls& controls, const PanelInput& input, const ControlRect& room, ReplayRequests& out);

 private:
  // What is looked at, as curves. They are made anew when it is another part.
  struct Curves {
    explicit Curves(double span);
    void push(const DriveSample& sample);
    Strip clutch, throttle;  // [1]
    Strip engine, shaft;     // [rad/s] without their sign
    Strip force;             // [N] of the hand
  };
  void follow(const Player& replay);
  void draw_legend(Controls& controls, const Player& replay);
  void draw_curves(const Player& replay);

  std::optional<Curves> curves_;
  const DriveSample* samples_ = nullptr;  // that they were made of
  double from_ = 0.0, to_ = 0.0;          // [s]
};

}  // namespace gearshift
