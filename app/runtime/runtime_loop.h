// A haptic loop with the load on its lever. A new loop is created when a recording starts.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "app/vehicle/car_load.h"
#include "app/vehicle/lesson_load.h"
#include "haptics/loop/haptic_loop.h"

namespace gearshift::runtime {

struct LoopRun {
  // Gate, device and inputs must outlive this object. Without a car the lever has no load and no guidance. Throws the
  // same errors as HapticLoop.
  LoopRun(const haptics::HapticConfig& config, const haptics::Gate& gate, haptics::HapticDevice& device,
          haptics::LoopInputs& inputs, std::uint64_t run_number, std::unique_ptr<vehicle::CarLoad> car_load = nullptr)
      : number(run_number),
        lesson(car_load ? std::make_unique<vehicle::LessonLoad>(std::move(car_load), gate) : nullptr),
        loop(config, gate, device, load(), inputs) {}
  LoopRun(const LoopRun&) = delete;
  LoopRun& operator=(const LoopRun&) = delete;

  haptics::LeverLoad& load() noexcept { return lesson ? static_cast<haptics::LeverLoad&>(*lesson) : no_load; }
  const vehicle::CarLoad* car() const noexcept { return lesson ? &lesson->car() : nullptr; }  // null: no car

  std::uint64_t number;  // >= 1; distinguishes this run from those before and after it
  haptics::NoLoad no_load;
  std::unique_ptr<vehicle::LessonLoad> lesson;
  haptics::HapticLoop loop;
};

}  // namespace gearshift::runtime
