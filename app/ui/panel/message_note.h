// A note over the cabin. It shows the newest message if the status bar is hidden or too narrow for the message. Above
// the message it shows what the user has to do, until the user has done it.
#pragma once

#include <string>
#include <string_view>

#include "app/ui/panel/controls.h"

namespace gearshift::ui {

class MessageNote {
 public:
  static constexpr double kShowTime = 8.0;  // [s] a message is shown for this long

  // Call once per frame. Draws along the upper edge of `room` [px]. is_in_bar: the status bar shows the whole message.
  // to_do: what the user has to do; may be empty.
  void draw(std::string_view message, bool is_in_bar, std::string_view to_do, const ControlRect& room);

 private:
  std::string message_;
  double arrived_at_ = -1e9;  // [s] on ImGui's clock
};

}  // namespace gearshift::ui
