// The stage: places everything in the cabin according to the state of lever and car. Uses only meshes and nodes, no
// GPU.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/cabin/stage/drive_side.h"
#include "app/cabin/stage/pointer_beam.h"
#include "app/vehicle/vehicle_state.h"
#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"
#include "haptics/gate/gate.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift::cabin {

struct StageConfig {
  haptics::Gate gate;
  haptics::YokeGeometry yoke;  // the drawn lever turns about the same centre as the device's yoke
  bool cutaway = false;        // show the cut-away gearbox next to the console
  bool open_gate = false;      // show a slotted plate of the loaded gate instead of the boot
  bool hand = true;            // show a hand on the knob
  DriveSide drive = DriveSide::left;
};

struct StageInput {
  haptics::HapticSnapshot lever;
  vehicle::VehicleState car;
  double time = 0.0;  // [s] for blinking and vibration
  // The driven and the shortest path of a replayed shift, in the gate plane [m]; empty: no path. The paths are drawn
  // just above the knob, with a transparent hand.
  std::span<const glm::dvec2> driven_path{}, ideal_path{};
  std::optional<Beam> pointer{};  // beam of the pointing controller
};

class Stage {
 public:
  // folder: assets/models. Throws GltfError (bad model file), std::runtime_error (a required node is missing).
  Stage(const StageConfig& config, const std::filesystem::path& folder);
  ~Stage();

  const engine::Model& model() const noexcept;  // static parts are merged; gate plate and gearbox match the gate
  // Returns true once after place() has changed the dial's textures in model() because the car's dials are others.
  bool take_dial_change() noexcept;

  // Places everything. The drawn lever follows the proxy with the exact kinematics; while kFlagGhost is set, the ghost
  // lever shows the lever point.
  void place(const StageInput& input);
  const engine::FrameScene& scene() const noexcept;

  // Positions in the world [m].
  glm::dvec3 knob() const noexcept;          // centre of the drawn knob
  glm::dvec3 ghost_knob() const noexcept;    // centre of a knob at the lever point
  glm::dvec3 knob_at_rest() const noexcept;  // centre of the knob with the lever upright
  glm::dvec3 knob_top() const noexcept;      // centre of the top of a knob at the lever point
  engine::EyePose driver_eye() const;        // pose of the camera "driver"

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Named cameras: "driver", "ahead", "lever", "gate", "cluster", "gearbox". Each camera has its subject in the middle
// square of the image, because the panel may cover the sides. For an unknown name, camera() and camera_field() throw
// std::invalid_argument with a message that lists all names.
engine::EyePose camera(std::string_view name, DriveSide side = DriveSide::left);
double camera_field(std::string_view name);  // [deg] field of view across the shorter side of the image

}  // namespace gearshift::cabin
