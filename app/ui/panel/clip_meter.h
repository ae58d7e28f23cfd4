// Compares the delivered force (f_a) with the rendered force, to show how much of the rendered force the device clips.
#pragma once

#include <imgui.h>

#include "app/ui/panel/clip_record.h"
#include "app/ui/panel/controls.h"
#include "haptics/device/haptic_device.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::ui {

class ClipMeter {
 public:
  void push(const haptics::HapticSnapshot& snapshot);
  // Draws across the full width of the window.
  void draw(Controls& controls, const haptics::HapticSnapshot& now, const haptics::DeviceSpec& device) const;
  static float height();  // [px]

 private:
  ClipRecord record_;
};

}  // namespace gearshift::ui
