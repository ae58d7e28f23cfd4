// The last message over the cabin, shown if the bar is hidden or too narrow for it. Above it, what the user has to do,
// for as long as it has to be done.
#pragma once

#include <string>

#include "app/ui/panel/controls.h"

namespace gearshift::ui {

class MessageNote {
 public:
  static constexpr double kShowTime = 8.0;  // [s] after it arrived

  // Call once per frame. Draws along the upper edge of `room` [px]. is_in_bar: the bar shows the whole message. to_do
  // may be empty.
  void draw(const std::string& message, bool is_in_bar, const std::string& to_do, const ControlRect& room);

 private:
  std::string message_;
  double came_at_ = -1e9;  // [s] on ImGui's clock
};

}  // namespace gearshift::ui
