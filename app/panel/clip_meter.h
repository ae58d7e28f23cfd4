// Given (f_a) against wanted force: what the device could not give.
#pragma once

#include <imgui.h>

#include "app/panel/clip_record.h"
#include "app/panel/controls.h"
#include "haptics/device/haptic_device.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

class ClipMeter {
 public:
  void push(const HapticSnapshot& snapshot);
  void draw(Controls& controls, const HapticSnapshot& now, const DeviceSpec& device) const;  // over the whole width
  static float height();                                                                     // [px] that it takes

 private:
  ClipRecord record_;
};

}  // namespace gearshift
