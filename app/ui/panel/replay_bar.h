// The replay bar of a recorded drive: shifts, curves, position and speed of the replay.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/ui/panel/panel.h"
#include "app/ui/panel/strip.h"

namespace gearshift::ui {

class ReplayBar {
 public:
  // Draws along the lower edge of `room` [px]. Returns the bar's upper edge [px], or the lower edge of `room` if there
  // is no replay.
  double draw(Controls& controls, const PanelInput& input, const ControlRect& room, PanelCommands& out);

 private:
  // Curves of the replayed part; rebuilt when a different part is selected.
  struct Curves {
    explicit Curves(double span);
    void push(const vehicle::DriveSample& sample);
    Strip clutch, throttle;  // [1]
    Strip engine, shaft;     // [rad/s] absolute values
    Strip force;             // [N] hand force
  };
  void follow(const lessons::Player& replay);
  void draw_legend(Controls& controls, const lessons::Player& replay);
  void draw_curves(const lessons::Player& replay);

  std::optional<Curves> curves_;
  const vehicle::DriveSample* samples_ = nullptr;  // recorded samples from which the curves were made
  double from_ = 0.0, to_ = 0.0;                   // [s]
};

}  // namespace gearshift::ui
