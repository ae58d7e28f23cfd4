// A note over the cabin: the last message, shown if the bar is hidden or too narrow for it; and above the message, what
// the user has to do, shown until it is done.
#pragma once

#include <string>

#include "app/ui/panel/controls.h"

namespace gearshift::ui {

class MessageNote {
 public:
  static constexpr double kShowTime = 8.0;  // [s] a message is shown for this long

  // Call once per frame. Draws along the upper edge of `room` [px]. is_in_bar: the bar shows the whole message. to_do:
  // what the user has to do; may be empty.
  void draw(const std::string& message, bool is_in_bar, const std::string& to_do, const ControlRect& room);

 private:
  std::string message_;
  double arrived_at_ = -1e9;  // [s] on ImGui's clock
};

}  // namespace gearshift::ui
