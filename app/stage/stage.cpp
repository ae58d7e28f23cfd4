#include "app/stage/stage.h"

#include <array>
#include <optional>
#include <span>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/stage/boot.h"
#include "app/stage/dial_print.h"
#include "app/stage/gearbox.h"
#include "app/stage/hand.h"
#include "app/stage/instruments.h"
#include "app/stage/lever_pose.h"
#include "app/stage/pieces.h"
#include "app/stage/roadside.h"
#include "app/stage/shift_light.h"
#include "app/stage/stage_model.h"
#include "app/stage/way.h"
#include "engine/model/skin.h"

namespace gearshift {
namespace {

constexpr double kKnobRadius = 0.024;  // [m] of the cabin's knob
constexpr float kGhostOpacity = 0.4f;
constexpr float kGlassHand = 0.25f;  // opacity of a hand with ways to see below it
constexpr float kExposure = 3.0f;    // for eyes inside: the cabin is darker than the road
constexpr ShadowRoom kCabin{{-0.45f, -0.31f, -1.25f}, {1.12f, 0.96f, 1.45f}};  // [m]
constexpr glm::vec3 kX{1.0f, 0.0f, 0.0f}, kZ{0.0f, 0.0f, 1.0f};

ShadowRoom room_of(DriveSide side) {
  if (side == DriveSide::left) return kCabin;
  ShadowRoom room = kCabin;
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
  Model model;
  std::vector<Node> pose;  // the nodes as they stand in this frame
  FrameScene scene;
  std::vector<Vertex> boot_at_rest;
  std::size_t hand_mesh = 0;     // of scene.deformed
  std::size_t first_way = 0;     // of scene.deformed: those that are shown in this frame
  std::vector<glm::mat4> world;  // of the nodes, in this frame
  DialPrint dial;
  bool new_print = false;
  Roadside road;
  std::optional<Hand> hand;
  std::optional<Gearbox> gearbox;
  std::array<int, kLampCount> lamp{};
  int lever = kNone, ghost = kNone, boot = kNone, wheel = kNone, tach = kNone, speed = kNone, gear_panel = kNone;
  int clutch = kNone, brake = kNone, throttle = kNone, hand_brake = kNone;
  int shift_up = kNone, shift_down = kNone, driven_way = kNone, ideal_way = kNone;
  int beam = kNone, beam_end = kNone;
  glm::dvec3 pivot{0.0};  // [m] world
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
    scene.shadow_room = room_of(config.drive);
    for (NodeState& state : scene.nodes) state.indoors = true;
    for (const std::string& name : outdoor_names())
      scene.nodes[static_cast<std::size_t>(needed_node(model, name))].indoors = false;
    scene.mirror = needed_node(model, "InteriorMirrorSurface");
    pivot = glm::dvec3(rest_pose(model)[static_cast<std::size_t>(lever)][3]);
    if (!config.open_gate) take_boot();
    if (config.hand) take_hand();
    first_way = scene.deformed.size();
    if (config.cutaway) gearbox.emplace(model, config.gate);
  }

  void find_nodes() {
    lever = needed_node(model, "LeverPivot");
    ghost = needed_node(model, "GhostPivot");
    boot = needed_node(model, "Boot");
    wheel = needed_node(model, "SteeringWheel");
    tach = needed_node(model, "TachNeedle");
    speed = needed_node(model, "SpeedNeedle");
    gear_panel = needed_node(model, "GearPanel");
    clutch = needed_node(model, "PedalClutch");
    brake = needed_node(model, "PedalBrake");
    throttle = needed_node(model, "PedalThrottle");
    hand_brake = needed_node(model, "Handbrake");
    shift_up = needed_node(model, kShiftUp);
    shift_down = needed_node(model, kShiftDown);
    driven_way = needed_node(model, kDrivenWay);
    ideal_way = needed_node(model, kIdealWay);
    beam = needed_node(model, kBeamNode);
    beam_end = needed_node(model, kBeamEndNode);
    for (std::size_t i = 0; i < lamp.size(); ++i) lamp[i] = needed_node(model, kLampNodes[i]);
  }

  void take_boot() {
    const Mesh& mesh = model.meshes[static_cast<std::size_t>(node(boot).mesh)];
    const auto first = model.vertices.begin() + mesh.first_vertex;
    boot_at_rest.assign(first, first + mesh.vertex_count);
    scene.deformed.push_back({node(boot).mesh, boot_at_rest});
  }

  void take_hand() {
    hand.emplace(model, config.drive);
    hand_mesh = scene.deformed.size();
    scene.deformed.push_back({node(hand->skin_node()).mesh, {}});
    skin_vertices(model, hand->skin_node(), rest_pose(model), scene.deformed.back().vertices);
  }

  const Node& node(int index) const { return model.nodes[static_cast<std::size_t>(index)]; }
  void turn(int index, glm::quat rotation) { pose[static_cast<std::size_t>(index)].rotation = rotation; }

  // What the hand holds shakes with the engine, sidewise and along.
  static glm::dvec2 shaken(glm::dvec2 plane, const VehicleState& car, double time) {
    return plane + kLeverTremble * glm::dvec2(tremble(car, time + 0.3), tremble(car, time));
  }

  void place_lever(const StageInput& input) {
    const HapticSnapshot& lever_state = input.lever;
    const glm::dvec2 drawn = shaken(lever_state.proxy, input.car, input.time);
    const glm::dquat rotation = lever_rotation(config.yoke, drawn);
    turn(lever, glm::quat(rotation));
    turn(ghost, glm::quat(lever_rotation(config.yoke, lever_state.lever)));
    knob = pivot + kDrawnLever * lever_direction(config.yoke, drawn);
    ghost_knob = pivot + kDrawnLever * lever_direction(config.yoke, lever_state.lever);
    const bool is_apart = (lever_state.flags & kFlagGhost) != 0;
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
    const VehicleState& car = input.car;
    new_print = dial.print(model, car.red_line) || new_print;
    const double swing = kNeedleTremble * tremble(car, input.time);
    turn(tach, about(kZ, tach_angle(car) + swing));
    turn(speed, about(kZ, speed_angle(car) + swing));
    scene.nodes[static_cast<std::size_t>(shift_up)].visible = car.shift_advice > 0;
    scene.nodes[static_cast<std::size_t>(shift_down)].visible = car.shift_advice < 0;
    turn(wheel, about(kZ, car.steering));
    turn(clutch, about(kX, pedal_angle(car.clutch)));
    turn(brake, about(kX, pedal_angle(car.brake)));
    turn(throttle, about(kX, pedal_angle(car.throttle)));
    turn(hand_brake, node(hand_brake).rotation * about(kX, hand_brake_angle(car.hand_brake)));
    scene.nodes[static_cast<std::size_t>(gear_panel)].uv_shift = gear_field(car.gear);
    for (int i = 0; i < kLampCount; ++i) {
      const auto at = static_cast<std::size_t>(lamp[static_cast<std::size_t>(i)]);
      scene.nodes[at].emissive = lamp_light(static_cast<Lamp>(i), car, input.lever, input.time);
    }
  }

  void place_ways(const StageInput& input) {
    scene.deformed.resize(first_way);
    const bool is_driven = show_way(driven_way, input.driven_way, kDrivenLook);
    const bool is_ideal = show_way(ideal_way, input.ideal_way, kIdealLook);
    if (hand) look_through_hand(is_driven || is_ideal);
  }

  // What is of glass has no ghost.
  void look_through_hand(bool is_glass) {
    scene.nodes[static_cast<std::size_t>(hand->skin_node())].opacity = is_glass ? kGlassHand : 1.0f;
    if (is_glass) scene.nodes[static_cast<std::size_t>(hand->ghost_node())].visible = false;
  }

  bool show_way(int index, std::span<const glm::dvec2> way, const WayLook& look) {
    DeformedMesh shape{node(index).mesh, {}};
    const bool is_shown = shape_way(way, config.yoke, look, shape.vertices);
    scene.nodes[static_cast<std::size_t>(index)].visible = is_shown;
    if (is_shown) scene.deformed.push_back(std::move(shape));
    return is_shown;
  }

  void place_pointer(const std::optional<Beam>& pointer) {
    NodeState &stick = scene.nodes[static_cast<std::size_t>(beam)],
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
      world[i] = parent == kNone ? pose[i].local() : world[static_cast<std::size_t>(parent)] * pose[i].local();
      scene.nodes[i].world = world[i];
    }
    if (!hand) return;
    skin_vertices(model, hand->skin_node(), world, scene.deformed[hand_mesh].vertices);
    scene.nodes[static_cast<std::size_t>(hand->skin_node())].world = glm::mat4(1.0f);  // skinned into the world
  }
};

Stage::Stage(const StageConfig& config, const std::filesystem::path& folder)
    : state_(std::make_unique<State>(config, folder)) {
  place({});
}

Stage::~Stage() = default;

const Model& Stage::model() const noexcept {
  return state_->model;
}

bool Stage::take_new_print() noexcept {
  return std::exchange(state_->new_print, false);
}

void Stage::place(const StageInput& input) {
  state_->place_lever(input);
  state_->place_instruments(input);
  state_->place_ways(input);
  state_->place_pointer(input.pointer);
  state_->road.place(input.car.distance, input.car.slope, state_->pose);
  if (state_->gearbox)
    state_->gearbox->place(state_->config.gate, input.lever.proxy, input.car, input.time, state_->pose);
  state_->resolve();
}

const FrameScene& Stage::scene() const noexcept {
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

EyePose Stage::driver_eye() const {
  return camera("driver", state_->config.drive);
}

}  // namespace gearshift
