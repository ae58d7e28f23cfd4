// A haptic loop with its channels and the load on its lever. A new loop is created when a recording starts.
#pragma once

#include <memory>
#include <utility>

#include "app/vehicle/car_load.h"
#include "app/vehicle/lesson_load.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift::runtime {

struct LoopRun {
  // Gate and device must outlive this object. Without a car the lever has no load and no guidance. Throws the same
  // errors as HapticLoop.
  LoopRun(const haptics::HapticConfig& config, const haptics::Gate& gate, haptics::HapticDevice& device,
          std::unique_ptr<vehicle::CarLoad> car_load = nullptr)
      : lesson(car_load ? std::make_unique<vehicle::LessonLoad>(std::move(car_load), gate) : nullptr),
        loop(config, gate, device, load(), channels) {}
  LoopRun(const LoopRun&) = delete;
  LoopRun& operator=(const LoopRun&) = delete;

  haptics::LeverLoad& load() noexcept { return lesson ? static_cast<haptics::LeverLoad&>(*lesson) : no_load; }
  const vehicle::CarLoad* car() const noexcept { return lesson ? &lesson->car() : nullptr; }  // null: no car

  haptics::LoopChannels channels;
  haptics::NoLoad no_load;
  std::unique_ptr<vehicle::LessonLoad> lesson;
  haptics::HapticLoop loop;
};

}  // namespace gearshift::runtime
