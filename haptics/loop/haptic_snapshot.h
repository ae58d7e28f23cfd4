// What the loop tells the rest of the program: the newest state, and the events that must not be missed.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/gate/gate.h"
#include "haptics/safety/force_guard.h"

namespace gearshift {

// Bits of HapticSnapshot::flags.
inline constexpr std::uint32_t kFlagContact = 1u << 0;    // the lever is pressed into a wall
inline constexpr std::uint32_t kFlagSaturated = 1u << 1;  // the wanted force was beyond the device
inline constexpr std::uint32_t kFlagOverPush = 1u << 2;   // the hand pushes above the warning threshold
inline constexpr std::uint32_t kFlagPushEstimated =
    1u << 3;                                          // no force sensor, or no number from it: the push is inferred
inline constexpr std::uint32_t kFlagGhost = 1u << 4;  // lever and drawn lever are too far apart
inline constexpr std::uint32_t kFlagFresh = 1u << 5;  // this cycle's reading was new and believed

struct HapticSnapshot {
  std::uint64_t cycle = 0;
  std::int64_t time_ns = 0;     // [ns] this cycle's deadline
  glm::dvec2 lever{0.0};        // [m] measured lever point
  glm::dvec2 velocity{0.0};     // [m/s] smoothed
  glm::dvec2 proxy{0.0};        // [m] drawn lever
  glm::dvec2 wall_force{0.0};   // [N] coupling
  glm::dvec2 feel_force{0.0};   // [N] gate's feel and damping
  glm::dvec2 world_force{0.0};  // [N] driveline
  glm::dvec2 commanded{0.0};    // [N] after the guard
  glm::dvec2 f_h{0.0};          // [N] eq (4): of the hand
  glm::dvec2 f_a{0.0};          // [N] eq (4): of the actuators, against the hand
  glm::dvec2 f_j{0.0};          // [N] eq (4): f_h - f_a, what moves the joystick
  double wall_stiffness = 0.0;  // [N/m] in use: what was admitted, less what the reversal limiter took
  double road_speed = 0.0;      // [m/s]
  int slot = kNoSlot;
  int gear = kNeutralGear;
  GuardState guard = GuardState::idle;
  GuardFault fault = GuardFault::none;
  std::uint32_t flags = 0;  // kFlag...
};

enum class EventKind : std::uint8_t {
  gear_engaged,     // value: gear
  gear_left,        // value: gear left
  wall_contact,     // value: impact speed [m/s]
  over_push_begin,  // value: push [N]
  over_push_end,
  saturation_begin,  // value: wanted force [N]
  saturation_end,
  guard_changed,     // value: GuardState
  stiffness_lowered  // value: stiffness in use from now on [N/m]; the lever chattered on a wall
};

struct HapticEvent {
  EventKind kind = EventKind::gear_engaged;
  std::uint64_t cycle = 0;
  std::int64_t time_ns = 0;  // [ns]
  double value = 0.0;
};

}  // namespace gearshift
