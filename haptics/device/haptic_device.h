// The one interface for every lever: simulated here, hardware later.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "haptics/joystick/plant.h"

namespace gearshift {

inline constexpr int kMostDelay = 15;  // [cycles] that the loop can account for

// What a device can do. The configuration is checked against it.
struct DeviceSpec {
  glm::dvec2 max_force{31.7};          // [N] peak per axis, select and shift
  glm::dvec2 continuous_force{10.83};  // [N] per axis, for ever
  glm::dvec2 workspace{0.0};           // [m] how far the tip reaches along each axis; less in the corners
  double yoke_radius = 0.0;            // [m] centre of the yoke to the tip; 0: the tip moves in the plane
  double position_step = 0.0;          // [m] encoder quantum at the tip
  int delay = 0;                       // [cycles] whole samples between write and effect, >= 0
  AxisModel axis_x = kPaperAxisX;      // bare handle, select
  AxisModel axis_y = kPaperAxisY;      // bare handle, shift
  bool measures_hand_force = false;    // a force sensor at the handle
  bool simulated = false;              // arms itself; may run studies that a person must not touch
};

// One sample of the lever. A reading is fresh when its sequence number differs from the last one's:
// a dead sensor cannot be taken for a live one.
struct LeverReading {
  std::uint64_t sequence = 0;      // counts samples taken by the device
  std::int64_t time_ns = 0;        // [ns] monotonic, when the sample was taken
  glm::dvec2 position{0.0};        // [m] tip in the gate plane: select right +, shift forward +
  glm::dvec2 hand_force{0.0};      // [N] of the hand on the knob, f_h of eq (4); 0 without a sensor
  glm::dvec2 actuator_force{0.0};  // [N] of the motors on the knob over the last cycle (= -f_a of eq (4))
  bool pressed_down = false;       // knob pushed down or reverse button held
  bool lifted = false;             // lift ring held
};

class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual const DeviceSpec& spec() const noexcept = 0;

  // Newest sample. now_ns is the deadline of this cycle on the loop's clock; it never waits. Real-time safe.
  virtual LeverReading read(std::int64_t now_ns) noexcept = 0;

  // Force on the knob from now on, in the gate plane. [N] Real-time safe.
  virtual void write(glm::dvec2 force) noexcept = 0;

  // Motors off, now, queued forces included. Real-time safe; may be called in any state and twice. A later write()
  // drives them again; the loop writes zero until it is armed.
  virtual void release() noexcept = 0;
};

}  // namespace gearshift
