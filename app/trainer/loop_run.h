// A haptic loop with its channels and its world: what is made anew where a recording begins.
#pragma once

#include <memory>
#include <utility>

#include "app/vehicle/car_world.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift {

struct LoopRun {
  // Gate and device must outlive it. Without a car there is nothing behind the lever. Throws as HapticLoop does.
  LoopRun(const HapticConfig& config, const Gate& gate, HapticDevice& device,
          std::unique_ptr<CarWorld> behind = nullptr)
      : car(std::move(behind)), loop(config, gate, device, world(), channels) {}
  LoopRun(const LoopRun&) = delete;
  LoopRun& operator=(const LoopRun&) = delete;

  LeverWorld& world() noexcept { return car ? static_cast<LeverWorld&>(*car) : nothing; }

  LoopChannels channels;
  NullWorld nothing;
  std::unique_ptr<CarWorld> car;
  HapticLoop loop;
};

}  // namespace gearshift
