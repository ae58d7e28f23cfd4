// Forces and position against time, and force against position, along one axis at a time.
#pragma once

#include <imgui.h>

#include <array>

#include "app/ui/panel/controls.h"
#include "app/ui/panel/strip.h"
#include "app/ui/panel/trail.h"
#include "haptics/gate/gate.h"

namespace gearshift::ui {

enum class PlotAxis : int { select, shift };

class ForcePlots {
 public:
  static constexpr double kSpan = 5.0;  // [s] time span of the plots against time

  void push(const haptics::HapticSnapshot& snapshot);
  void clear() { axes_ = {}; }  // call when a new run starts: its curves must not join the old ones
  void draw_axis_choice(Controls& controls);
  // Draws the plots at the cursor, one below the other, in full width, `height` [px] in total.
  void draw(Controls& controls, float height, const haptics::Gate& gate, const haptics::HapticSnapshot& now,
            const Trail& trail);

 private:
  struct Axis {
    Strip hand{kSpan, 1}, actuator{kSpan, 1}, joystick{kSpan, 1};  // [N]
    Strip lever{kSpan, 1}, proxy{kSpan, 1};                        // [m]
  };
  Axis& axis() { return axes_[static_cast<std::size_t>(axis_)]; }
  void draw_forces(Controls& controls, float height, const haptics::HapticSnapshot& now);
  void draw_position(Controls& controls, float height, const haptics::Gate& gate, const haptics::HapticSnapshot& now);
  void draw_force_at_position(Controls& controls, float height, const haptics::Gate& gate,
                              const haptics::HapticSnapshot& now, const Trail& trail);

  std::array<Axis, 2> axes_;
  PlotAxis axis_ = PlotAxis::shift;
};

}  // namespace gearshift::ui
