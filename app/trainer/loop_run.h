// A haptic loop with its channels: what is made anew where a recording begins.
#pragma once

#include "haptics/loop/haptic_loop.h"

namespace gearshift {

struct LoopRun {
  // Gate and device must outlive it. Throws as HapticLoop does.
  LoopRun(const HapticConfig& config, const Gate& gate, HapticDevice& device)
      : loop(config, gate, device, world, channels) {}
  LoopRun(const LoopRun&) = delete;
  LoopRun& operator=(const LoopRun&) = delete;

  LoopChannels channels;
  NullWorld world;
  HapticLoop loop;
};

}  // namespace gearshift
