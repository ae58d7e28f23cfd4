// Output of one cycle of the loop.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/safety/force_guard.h"

namespace gearshift::haptics {

// Bits of HapticSnapshot::flags.
inline constexpr std::uint32_t kFlagContact = 1u << 0;        // the lever is pressed into a wall
inline constexpr std::uint32_t kFlagSaturated = 1u << 1;      // the wanted force exceeds the device's limit
inline constexpr std::uint32_t kFlagOverPush = 1u << 2;       // the hand pushes harder than the warning threshold
inline constexpr std::uint32_t kFlagPushEstimated = 1u << 3;  // the push is estimated, for lack of a sensor value
inline constexpr std::uint32_t kFlagGhost = 1u << 4;          // lever and proxy are further apart than ghost_offset
inline constexpr std::uint32_t kFlagFresh = 1u << 5;          // this cycle's reading was new and plausible

struct HapticSnapshot {
  std::uint64_t cycle = 0;
  std::int64_t time_ns = 0;     // [ns] this cycle's deadline
  glm::dvec2 lever{0.0};        // [m] measured lever point
  glm::dvec2 velocity{0.0};     // [m/s] smoothed
  glm::dvec2 proxy{0.0};        // [m] position of the drawn lever
  glm::dvec2 wall_force{0.0};   // [N] coupling
  glm::dvec2 feel_force{0.0};   // [N] gate's feel and damping
  glm::dvec2 load_force{0.0};   // [N] driveline
  glm::dvec2 commanded{0.0};    // [N] force after the guard
  glm::dvec2 f_h{0.0};          // [N] force of the hand, the paper's eq (4)
  glm::dvec2 f_a{0.0};          // [N] force of the actuators against the hand, the paper's eq (4)
  glm::dvec2 f_j{0.0};          // [N] f_h - f_a, the force that moves the joystick, the paper's eq (4)
  double wall_stiffness = 0.0;  // [N/m] admitted stiffness, lowered by the reversal limiter
  double road_speed = 0.0;      // [m/s]
  int slot = kNoSlot;
  int gear = kNeutralGear;
  GuardState guard = GuardState::idle;
  GuardFault fault = GuardFault::none;
  std::uint32_t flags = 0;  // kFlag...
};

}  // namespace gearshift::haptics
