// From what the loop and the car say to where everything stands in the cabin. Knows meshes and nodes, no GPU.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/stage/drive_side.h"
#include "app/stage/pointer_beam.h"
#include "app/vehicle/vehicle_state.h"
#include "engine/model/model.h"
#include "engine/scene/frame_scene.h"
#include "engine/scene/view.h"
#include "haptics/gate/gate.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/haptic_snapshot.h"

namespace gearshift {

struct StageConfig {
  Gate gate;
  YokeGeometry yoke;       // the drawn lever turns about the same centre as the device's yoke
  bool cutaway = false;    // the gearbox is seen beside the console
  bool open_gate = false;  // a slotted plate of the loaded gate in place of the boot
  bool hand = true;        // a hand on the knob
  DriveSide drive = DriveSide::left;
};

struct StageInput {
  HapticSnapshot lever;
  VehicleState car;
  double time = 0.0;  // [s] for what blinks
  // Of a shift that is looked at again, drawn just above the knob: the way that it took, and the shortest. In the gate
  // plane [m]; empty: none. The hand is of glass then.
  std::span<const glm::dvec2> driven_way{}, ideal_way{};
  std::optional<Beam> pointer{};  // of a hand that points at something
};

class Stage {
 public:
  // folder: assets/models. Throws GltfError (a model), std::runtime_error (a node that the stage needs is missing).
  Stage(const StageConfig& config, const std::filesystem::path& folder);
  ~Stage();

  const Model& model() const noexcept;  // static parts merged, gate plate and gearbox made for the gate
  // Once true after place() was given a car with another red line than the one before: model()'s dial is printed anew.
  bool take_new_print() noexcept;

  // Places everything. The drawn lever is the proxy, through the exact kinematics; past the offset at which the loop
  // raises kFlagGhost the ghost stands where the lever point is.
  void place(const StageInput& input);
  const FrameScene& scene() const noexcept;

  glm::dvec3 knob() const noexcept;        // [m] world, centre of the drawn knob
  glm::dvec3 ghost_knob() const noexcept;  // [m] world, where the lever point is
  // [m] world: centre of the knob of the upright lever, and the middle of the knob's top where the lever point is.
  glm::dvec3 knob_at_rest() const noexcept;
  glm::dvec3 knob_top() const noexcept;
  EyePose driver_eye() const;  // at rest, looking ahead and a little down

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Named cameras: "driver", "ahead", "lever", "gate", "cluster", "gearbox". What each is for lies in the middle square of
// the picture: the panel may cover the sides. Throw std::invalid_argument naming them all.
EyePose camera(std::string_view name, DriveSide side = DriveSide::left);
double camera_field(std::string_view name);  // [deg] across the shorter side of the picture; on both sides alike

}  // namespace gearshift
