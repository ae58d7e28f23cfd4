// A haptic loop with its channels and its world: what is made anew where a recording begins.
#pragma once

#include <memory>
#include <utility>

#include "app/training/lesson_world.h"
#include "app/vehicle/car_world.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift {

struct LoopRun {
  // Gate and device must outlive it. Without a car there is nothing behind the lever, and nobody guides it. Throws as
  // HapticLoop does.
  LoopRun(const HapticConfig& config, const Gate& gate, HapticDevice& device,
          std::unique_ptr<CarWorld> behind = nullptr)
      : lesson(behind ? std::make_unique<LessonWorld>(std::move(behind), gate) : nullptr),
        loop(config, gate, device, world(), channels) {}
  LoopRun(const LoopRun&) = delete;
  LoopRun& operator=(const LoopRun&) = delete;

  LeverWorld& world() noexcept { return lesson ? static_cast<LeverWorld&>(*lesson) : nothing; }
  const CarWorld* car() const noexcept { return lesson ? &lesson->car() : nullptr; }  // null: none

  LoopChannels channels;
  NullWorld nothing;
  std::unique_ptr<LessonWorld> lesson;
  HapticLoop loop;
};

}  // namespace gearshift
