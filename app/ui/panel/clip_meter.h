// Delivered (f_a) against rendered force: shows how much the device clips.
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
  void draw(Controls& controls, const haptics::HapticSnapshot& now,
            const haptics::DeviceSpec& device) const;  // full width
  static float height();                               // [px]

 private:
  ClipRecord record_;
};

}  // namespace gearshift::ui
