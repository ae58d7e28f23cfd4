#include "app/cabin/stage/stage.h"

#include <array>
#include <optional>
#include <span>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/cabin/stage/boot.h"
#include "app/cabin/stage/dial_print.h"
#include "app/cabin/stage/gearbox.h"
#include "app/cabin/stage/hand.h"
#include "app/cabin/stage/instruments.h"
#include "app/cabin/stage/lever_pose.h"
#include "app/cabin/stage/mesh_parts.h"
#include "app/cabin/stage/path_ribbon.h"
#include "app/cabin/stage/roadside.h"
#include "app/cabin/stage/shift_light.h"
#include "app/cabin/stage/stage_model.h"
#include "engine/model/skin.h"

namespace gearshift::cabin {
namespace {

constexpr double kKnobRadius = 0.024;  // [m] radius of the knob in the cabin model
constexpr float kGhostOpacity = 0.4f;
constexpr float kTransparentHand = 0.25f;  // opacity of the hand while paths are shown
constexpr float kExposure = 3.0f;          // exposure for views from inside the cabin, which is darker than the road
constexpr engine::ShadowBounds kCabin{{-0.45f, -0.31f, -1.25f}, {1.12f, 0.96f, 1.45f}};  // [m]
constexpr glm::vec3 kX{1.0f, 0.0f, 0.0f}, kZ{0.0f, 0.0f, 1.0f};

engine::ShadowBounds room_of(DriveSide side) {
  if (side == DriveSide::left) return kCabin;
  engine::ShadowBounds room = kCabin;
  room.low.x = static_cast<float>(2.0 * kMirrorPlane) - kCabin.high.x;
  room.high.x = static_cast<float>(2.0 * kMirrorPlane) - kCabin.low.x;
  return room;
}

glm::quat about(glm::vec3 axis, double angle) {
  return glm::angleAxis(static_cast<float>(angle), axis);
}

}  // namespace

struct Stage::State {
  StageConfig config;
  engine::Model model;
  std::vector<engine::Node> pose;  // nodes as placed in this frame
  engine::FrameScene scene;
  std::vector<engine::Vertex> boot_at_rest;
  std::size_t hand_mesh = 0;     // index of the hand in scene.deformed
  std::size_t first_path = 0;    // index of the first path in scene.deformed
  std::vector<glm::mat4> world;  // node transforms in this frame
  DialPrint dial;
  bool dial_changed = false;
  Roadside road;
  std::optional<Hand> hand;
  std::optional<Gearbox> gearbox;
  std::array<int, kLampCount> lamp{};
  int lever = engine::kNone, ghost = engine::kNone, boot = engine::kNone, tach = engine::kNone, speed = engine::kNone,
      gear_panel = engine::kNone;
  int clutch = engine::kNone, brake = engine::kNone, throttle = engine::kNone, hand_brake = engine::kNone;
  int shift_up = engine::kNone, shift_down = engine::kNone, driven_path = engine::kNone, ideal_path = engine::kNone;
  int beam = engine::kNone, beam_end = engine::kNone;
  glm::dvec3 pivot{0.0};  // [m] the lever's pivot in the world
  glm::dvec3 knob{0.0}, ghost_knob{0.0};

  State(const StageConfig& stage_config, const std::filesystem::path& folder)
      : config(stage_config),
        model(make_stage_model(config, folder)),
        pose(model.nodes),
        world(model.nodes.size()),
        dial(model),
        road(model) {
    find_nodes();
    scene.nodes.resize(model.nodes.size());
    scene.exposure = kExposure;
    scene.shadow_bounds = room_of(config.drive);
    for (engine::NodeState& state : scene.nodes) state.indoors = true;
    for (const std::string& name : outdoor_names())
      scene.nodes[static_cast<std::size_t>(required_node(model, name))].indoors = false;
    scene.mirror = required_node(model, "InteriorMirrorSurface");
    pivot = glm::dvec3(engine::rest_pose(model)[static_cast<std::size_t>(lever)][3]);
    if (!config.open_gate) add_boot();
    if (config.hand) add_hand();
    first_path = scene.deformed.size();
    if (config.cutaway) gearbox.emplace(model, config.gate);
  }

  void find_nodes() {
    lever = required_node(model, "LeverPivot");
    ghost = required_node(model, "GhostPivot");
    boot = required_node(model, "Boot");
    tach = required_node(model, "TachNeedle");
    speed = required_node(model, "SpeedNeedle");
    gear_panel = required_node(model, "GearPanel");
    clutch = required_node(model, "PedalClutch");
    brake = required_node(model, "PedalBrake");
    throttle = required_node(model, "PedalThrottle");
    hand_brake = required_node(model, "Handbrake");
    shift_up = required_node(model, kShiftUp);
    shift_down = required_node(model, kShiftDown);
    driven_path = required_node(model, kDrivenPath);
    ideal_path = required_node(model, kIdealPath);
    beam = required_node(model, kBeamNode);
    beam_end = required_node(model, kBeamEndNode);
    for (std::size_t i = 0; i < lamp.size(); ++i) lamp[i] = required_node(model, kLampNodes[i]);
  }

  void add_boot() {
    const engine::Mesh& mesh = model.meshes[static_cast<std::size_t>(node(boot).mesh)];
    const auto first = model.vertices.begin() + mesh.first_vertex;
    boot_at_rest.assign(first, first + mesh.vertex_count);
    scene.deformed.push_back({node(boot).mesh, boot_at_rest});
  }

  void add_hand() {
    hand.emplace(model, config.drive);
    hand_mesh = scene.deformed.size();
    scene.deformed.push_back({node(hand->skin_node()).mesh, {}});
    engine::skin_vertices(model, hand->skin_node(), engine::rest_pose(model), scene.deformed.back().vertices);
  }

  const engine::Node& node(int index) const { return model.nodes[static_cast<std::size_t>(index)]; }
  void turn(int index, glm::quat rotation) { pose[static_cast<std::size_t>(index)].rotation = rotation; }

  // Adds the vibration of a labouring engine to the lever's position, along both axes.
  static glm::dvec2 with_vibration(glm::dvec2 plane, const vehicle::VehicleState& car, double time) {
    return plane + kLeverVibration * glm::dvec2(vibration(car, time + 0.3), vibration(car, time));
  }

  void place_lever(const StageInput& input) {
    const haptics::HapticSnapshot& lever_state = input.lever;
    const glm::dvec2 drawn = with_vibration(lever_state.proxy, input.car, input.time);
    const glm::dquat rotation = lever_rotation(config.yoke, drawn);
    turn(lever, glm::quat(rotation));
    turn(ghost, glm::quat(lever_rotation(config.yoke, lever_state.lever)));
    knob = pivot + kDrawnLever * lever_direction(config.yoke, drawn);
    ghost_knob = pivot + kDrawnLever * lever_direction(config.yoke, lever_state.lever);
    const bool is_apart = (lever_state.flags & haptics::kFlagGhost) != 0;
    show_below(ghost, is_apart, kGhostOpacity);
    if (hand) {
      hand->place(knob, rotation, pose);
      show_below(hand->ghost_node(), is_apart, kGhostOpacity);
      pose[static_cast<std::size_t>(hand->ghost_node())].translation = glm::vec3(ghost_knob - knob);
    }
    if (!boot_at_rest.empty()) deform_boot(boot_at_rest, rotation, scene.deformed.front().vertices);
  }

  void show_below(int top, bool visible, float opacity) {
    for (std::size_t i = static_cast<std::size_t>(top); i < pose.size(); ++i) {
      if (static_cast<int>(i) != top && !is_below(static_cast<int>(i), top)) continue;
      scene.nodes[i].visible = visible;
      scene.nodes[i].opacity = opacity;
    }
  }

  bool is_below(int index, int top) const {
    while (index > top) index = node(index).parent;
    return index == top;
  }

  void place_instruments(const StageInput& input) {
    const vehicle::VehicleState& car = input.car;
    dial_changed = dial.print(model, car) || dial_changed;
    const double swing = kNeedleVibration * vibration(car, input.time);
    turn(tach, about(kZ, tach_angle(car) + swing));
    turn(speed, about(kZ, speed_angle(car) + swing));
    scene.nodes[static_cast<std::size_t>(shift_up)].visible = car.shift_advice > 0;
    scene.nodes[static_cast<std::size_t>(shift_down)].visible = car.shift_advice < 0;
    turn(clutch, about(kX, pedal_angle(car.pedals.clutch)));
    turn(brake, about(kX, pedal_angle(car.pedals.brake)));
    turn(throttle, about(kX, pedal_angle(car.pedals.throttle)));
    turn(hand_brake, node(hand_brake).rotation * about(kX, hand_brake_angle(car.pedals.hand_brake)));
    scene.nodes[static_cast<std::size_t>(gear_panel)].uv_shift = gear_field(car.gear);
    for (int i = 0; i < kLampCount; ++i) {
      const auto at = static_cast<std::size_t>(lamp[static_cast<std::size_t>(i)]);
      scene.nodes[at].emissive = lamp_light(static_cast<Lamp>(i), car, input.lever);
    }
  }

  void place_paths(const StageInput& input) {
    scene.deformed.resize(first_path);
    const bool is_driven = show_path(driven_path, input.driven_path, kDrivenStyle);
    const bool is_ideal = show_path(ideal_path, input.ideal_path, kIdealStyle);
    if (hand) set_hand_transparent(is_driven || is_ideal);
  }

  // Makes the hand transparent or opaque. While the hand is transparent, the ghost hand is hidden.
  void set_hand_transparent(bool is_glass) {
    scene.nodes[static_cast<std::size_t>(hand->skin_node())].opacity = is_glass ? kTransparentHand : 1.0f;
    if (is_glass) scene.nodes[static_cast<std::size_t>(hand->ghost_node())].visible = false;
  }

  bool show_path(int index, std::span<const glm::dvec2> path, const PathStyle& style) {
    engine::DeformedMesh shape{node(index).mesh, {}};
    const bool is_shown = shape_path(path, config.yoke, style, shape.vertices);
    scene.nodes[static_cast<std::size_t>(index)].visible = is_shown;
    if (is_shown) scene.deformed.push_back(std::move(shape));
    return is_shown;
  }

  void place_pointer(const std::optional<Beam>& pointer) {
    engine::NodeState &stick = scene.nodes[static_cast<std::size_t>(beam)],
                      &end = scene.nodes[static_cast<std::size_t>(beam_end)];
    stick.opacity = end.opacity = kBeamOpacity;
    end.visible = pointer.has_value();
    stick.visible = pointer && pointer->from != pointer->to;
    if (stick.visible) place_beam_stick(*pointer, pose[static_cast<std::size_t>(beam)]);
    if (end.visible) pose[static_cast<std::size_t>(beam_end)].translation = glm::vec3(pointer->to);
  }

  void resolve() {
    for (std::size_t i = 0; i < pose.size(); ++i) {
      const int parent = pose[i].parent;
      world[i] = parent == engine::kNone ? pose[i].local() : world[static_cast<std::size_t>(parent)] * pose[i].local();
      scene.nodes[i].world = world[i];
    }
    if (!hand) return;
    engine::skin_vertices(model, hand->skin_node(), world, scene.deformed[hand_mesh].vertices);
    // The skinned vertices are already in world coordinates.
    scene.nodes[static_cast<std::size_t>(hand->skin_node())].world = glm::mat4(1.0f);
  }
};

Stage::Stage(const StageConfig& config, const std::filesystem::path& folder)
    : state_(std::make_unique<State>(config, folder)) {
  place({});
}

Stage::~Stage() = default;

const engine::Model& Stage::model() const noexcept {
  return state_->model;
}

bool Stage::take_dial_change() noexcept {
  return std::exchange(state_->dial_changed, false);
}

void Stage::place(const StageInput& input) {
  state_->place_lever(input);
  state_->place_instruments(input);
  state_->place_paths(input);
  state_->place_pointer(input.pointer);
  state_->road.place(input.car.distance, input.car.slope, state_->pose);
  if (state_->gearbox)
    state_->gearbox->place(state_->config.gate, input.lever.proxy, input.car, input.time, state_->pose);
  state_->resolve();
}

const engine::FrameScene& Stage::scene() const noexcept {
  return state_->scene;
}

glm::dvec3 Stage::knob() const noexcept {
  return state_->knob;
}

glm::dvec3 Stage::ghost_knob() const noexcept {
  return state_->ghost_knob;
}

glm::dvec3 Stage::knob_at_rest() const noexcept {
  return state_->pivot + glm::dvec3(0.0, kDrawnLever, 0.0);
}

glm::dvec3 Stage::knob_top() const noexcept {
  const glm::dvec3 lever = state_->ghost_knob - state_->pivot;
  return state_->pivot + (kDrawnLever + kKnobRadius) / kDrawnLever * lever;
}

engine::EyePose Stage::driver_eye() const {
  return camera("driver", state_->config.drive);
}

}  // namespace gearshift::cabin
