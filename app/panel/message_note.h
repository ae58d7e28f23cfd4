// The last refusal or news over the cabin, where the bar does not say it: it is hidden, or has no room for all of it. Above
// it what a person has to do, for as long as that is so.
#pragma once

#include <string>

#include "app/panel/controls.h"

namespace gearshift {

class MessageNote {
 public:
  static constexpr double kSeen = 8.0;  // [s] since it came

  // Along the upper edge of that room [px], in each frame; told: the bar says all of the message. to_do may be empty.
  void draw(const std::string& message, bool told, const std::string& to_do, const ControlRect& room);

 private:
  std::string message_;
  double came_at_ = -1e9;  // [s] on the frames' clock
};

}  // namespace gearshift
