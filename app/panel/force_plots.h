// Forces and position against time, and force against position, along one axis at a time.
#pragma once

#include <imgui.h>

#include <array>

#include "app/panel/controls.h"
#include "app/panel/strip.h"
#include "app/panel/trail.h"
#include "haptics/gate/gate.h"

namespace gearshift {

enum class PlotAxis : int { select, shift };

class ForcePlots {
 public:
  static constexpr double kSpan = 5.0;  // [s] of the plots against time

  void push(const HapticSnapshot& snapshot);
  void forget() { axes_ = {}; }  // another run: what was plotted is not joined to it
  void draw_axis_choice(Controls& controls);
  // One below the other in that height at the cursor [px], over the whole width.
  void draw(Controls& controls, float height, const Gate& gate, const HapticSnapshot& now, const Trail& trail);

 private:
  struct Axis {
    Strip hand{kSpan, 1}, actuator{kSpan, 1}, joystick{kSpan, 1};  // [N]
    Strip lever{kSpan, 1}, proxy{kSpan, 1};                        // [m]
  };
  Axis& axis() { return axes_[static_cast<std::size_t>(axis_)]; }
  void draw_forces(Controls& controls, float height, const HapticSnapshot& now);
  void draw_position(Controls& controls, float height, const Gate& gate, const HapticSnapshot& now);
  void draw_force_at_position(Controls& controls, float height, const Gate& gate, const HapticSnapshot& now,
                              const Trail& trail);

  std::array<Axis, 2> axes_;
  PlotAxis axis_ = PlotAxis::shift;
};

}  // namespace gearshift
