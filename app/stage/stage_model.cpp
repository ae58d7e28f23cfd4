#include "app/stage/stage_model.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "app/stage/door_mirror.h"
#include "app/stage/gate_plate.h"
#include "app/stage/gearbox.h"
#include "app/stage/hand.h"
#include "app/stage/instruments.h"
#include "app/stage/lever_pose.h"
#include "app/stage/mirror_image.h"
#include "app/stage/pieces.h"
#include "app/stage/pointer_beam.h"
#include "app/stage/roadside.h"
#include "app/stage/shift_light.h"
#include "app/stage/strokes.h"
#include "app/stage/way.h"
#include "engine/model/assemble.h"
#include "engine/model/gltf.h"

namespace gearshift {
namespace {

constexpr glm::vec3 kCapGround{0.012f}, kCapInk{0.75f}, kCapReverse{0.62f, 0.035f, 0.025f};  // linear
constexpr int kCapSide = 256;                                                                // [px]
constexpr float kModelRod = 0.006f;         // [m] radius of the cabin's LeverRod
constexpr glm::dvec2 kLamp{-0.052, 0.059};  // [m] on the boot's frame, front left: no hand hides it from the driver
constexpr double kLampRadius = 0.0040;      // [m]
constexpr const char* kBodywork = "Bodywork";
constexpr std::array kPedals{"PedalClutch", "PedalBrake", "PedalThrottle"};

// What is the same in a right-hand-drive car, only elsewhere: print, what is held, what turns.
constexpr std::string_view kUpright[] = {
    "Cluster",    "RadioScreen",   "ClimatePrint", "HazardButton", "SteeringColumn", "PedalClutch",
    "PedalBrake", "PedalThrottle", "LeverPivot",   "GhostPivot",   "Boot",           "GatePlate",
    "BootRing",   "GateInsert",    kDrivenWay,     kIdealWay,      "Gearbox"};

Node& node_of(Model& model, std::string_view name) {
  return model.nodes[static_cast<std::size_t>(needed_node(model, name))];
}

void hide(Model& model, std::string_view name) {
  node_of(model, name).mesh = kNone;
}

// Draws that nobody would miss: small faces of one material are shown in another that the part has too, what turns
// about its own axis of symmetry stands still.
void join_draws(Model& cabin) {
  for (const char* pedal : kPedals) {
    repaint(cabin, pedal, "PlasticHard", "PlasticSoft");
  }
  repaint(cabin, "Handbrake", "PlasticGloss", "MetalSatin");
  repaint(cabin, "SteeringWheel", "PlasticSoft", "PlasticHard");
  leave_behind(cabin, "TachNeedle", "PlasticGloss");
  leave_behind(cabin, "SpeedNeedle", "PlasticGloss");
  Node& ring = node_of(cabin, "BootRing");  // the boot bends, its ring does not
  const Node& boot = node_of(cabin, "Boot");
  ring.translation += boot.translation;
  ring.parent = boot.parent;
}

// What of the cabin's file is lit by the open sky, in one mesh at a node of its own.
void gather_bodywork(Model& cabin) {
  const std::vector<glm::mat4> world = rest_pose(cabin);
  std::vector<Piece> pieces;
  for (const char* name : {"Bonnet", "Wipers", "DoorMirrorLeftHousing", "DoorMirrorLeftSurface",
                           "DoorMirrorRightHousing", "DoorMirrorRightSurface"}) {
    const int node = needed_node(cabin, name);
    for (Piece& piece : placed_pieces(cabin, node, world[static_cast<std::size_t>(node)])) {
      if (std::string_view(name).ends_with("Surface")) make_convex(piece.patch);
      pieces.push_back(std::move(piece));
    }
    hide(cabin, name);
  }
  Node bodywork;
  bodywork.name = kBodywork;
  cabin.nodes.push_back(std::move(bodywork));
  set_pieces(cabin, static_cast<int>(cabin.nodes.size()) - 1, pieces);
}

Material plain_material(std::string name, glm::vec3 colour, float metallic, float roughness) {
  Material material;
  material.name = std::move(name);
  material.base_colour = glm::vec4(colour, 1.0f);
  material.metallic = metallic;
  material.roughness = roughness;
  return material;
}

int add_material(Model& model, Material material) {
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

// The pattern of the loaded gate on the knob's cap.
void draw_knob_cap(Model& model, const Gate& gate) {
  Texture texture;
  texture.pixels = draw_strokes(shift_pattern(gate, kCapInk, kCapReverse), kCapSide, kCapGround);
  texture.srgb = true;
  texture.wrap_u = texture.wrap_v = Wrap::clamp;
  model.textures.push_back(std::move(texture));
  Material& material = model.materials[static_cast<std::size_t>(needed_material(model, "KnobCap"))];
  material = plain_material("KnobCap", glm::vec3(1.0f), 0.0f, 0.35f);
  material.base_colour_map.texture = static_cast<int>(model.textures.size()) - 1;
}

// A red lens beside the gate: the warning stands where the eye is when the hand pushes too hard.
void add_lever_lamp(Model& model, const Node& beside, glm::vec3 offset) {
  Material red = plain_material("LampLever", glm::vec3(0.25f, 0.01f, 0.01f), 0.0f, 0.25f);
  red.emissive = glm::vec3(1.5f, 0.03f, 0.02f);
  const int lit = add_material(model, red);
  Patch lens;
  const int rings = 3, steps = 20;
  std::vector<Loop> ring(static_cast<std::size_t>(rings + 1));
  std::vector<double> height;
  for (int i = 0; i <= rings; ++i) {
    const double lean = 0.5 * std::numbers::pi * (1.0 - static_cast<double>(i) / rings);
    height.push_back(0.4 * kLampRadius * std::cos(lean));
    for (int k = 0; k < steps; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / steps;
      const double radius = std::max(1e-5, kLampRadius * std::sin(lean));
      ring[static_cast<std::size_t>(i)].push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(rings); ++i) {
    add_wall(lens, {ring[i + 1], height[i + 1]}, {ring[i], height[i]}, Seen::from_right);
  }
  const std::array<MeshPiece, 1> pieces{MeshPiece{lens, lit}};
  add_mesh_node(model, "LampLever", pieces, beside.translation + offset, beside.parent);
}

// The plate stands at the pivot's node, where it does not move; boot and frame make room, the lever gets as thin as
// the slots ask for.
void open_the_gate(Model& model, const StageConfig& config) {
  const GatePlate plate = make_gate_plate(config.gate, config.yoke);
  for (const char* name : {"Boot", "BootRing", "GatePlate"}) hide(model, name);
  const int metal = add_material(model, plain_material("GateMetal", glm::vec3(0.20f, 0.203f, 0.21f), 1.0f, 0.50f));
  const int ink = add_material(model, plain_material("GateInk", glm::vec3(1.0f), 0.0f, 0.95f));
  const Node pivot = node_of(model, "LeverPivot");
  const std::array<MeshPiece, 3> pieces{MeshPiece{plate.metal, metal}, MeshPiece{plate.ink, ink},
                                        MeshPiece{plate.plinth, needed_material(model, "PlasticHard")}};
  add_mesh_node(model, "GateInsert", pieces, pivot.translation, pivot.parent);
  add_lever_lamp(model, pivot, above(plate.lamp, kPlateHeight));
  const float thin = static_cast<float>(plate.opening.rod_radius) / kModelRod;
  node_of(model, "LeverRod").scale = glm::vec3(thin, 1.0f, thin);
}

// Rod, collar and knob move as one. After open_the_gate(), which makes the rod thin.
void join_lever(Model& model) {
  for (const char* part : {"LeverRod", "LeverCollar"}) join_into(model, part, "Knob");
}

// A second lever for the place where the hand is: shown translucent, without a boot.
void add_ghost(Model& model) {
  const int pivot = needed_node(model, "LeverPivot");
  const int ghost = add_twin(model, pivot, "GhostPivot", model.nodes[static_cast<std::size_t>(pivot)].parent);
  const int knob = add_twin(model, needed_node(model, "Knob"), "GhostKnob", ghost);
  add_twin(model, needed_node(model, "KnobCap"), "GhostCap", knob);
}

glm::vec3 pivot_at_rest(const Model& model) {
  return glm::vec3(rest_pose(model)[static_cast<std::size_t>(needed_node(model, "LeverPivot"))][3]);
}

glm::vec3 knob_at_rest(const Model& model) {
  return pivot_at_rest(model) + glm::vec3(0.0f, static_cast<float>(kDrawnLever), 0.0f);
}

// All at once, before what stands still is merged. The clutch stays left of the brake: pedals stand to their driver as
// they did. The footrest stays before its wheel, though that is beside the throttle now: the tunnel leaves it no room,
// and without it the floor shows the hole and the dark that were baked behind it.
void sit_on_the_right(Model& model) {
  mirror_model(model, static_cast<float>(kMirrorPlane), kUpright);
  for (const char* pedal : kPedals) {
    Node& node = node_of(model, pedal);
    node.translation.x = -node.translation.x;
  }
}

// The sign is to be read, the box to be open towards the driver: both are mirrored once more, or once before.
Model road_things(const StageConfig& config, const std::filesystem::path& folder) {
  Model road = read_gltf(folder / "road.glb");
  if (config.drive == DriveSide::right) mirror_mesh(road, node_of(road, "Sign").mesh);
  return road;
}

Model gearbox_parts(const StageConfig& config, const std::filesystem::path& folder) {
  Model parts = read_gltf(folder / "gearbox.glb");
  if (config.drive == DriveSide::right) mirror_model(parts, 0.0f, {});
  return parts;
}

std::vector<std::string> moving_names(const StageConfig& config) {
  std::vector<std::string> names = {
      "LeverPivot", "Boot",          "TachNeedle", "SpeedNeedle", "SteeringWheel",         "PedalClutch", "PedalBrake",
      "GearPanel",  "PedalThrottle", "Handbrake",  "GhostPivot",  "InteriorMirrorSurface", kBodywork};
  names.insert(names.end(), kLampNodes.begin(), kLampNodes.end());
  names.insert(names.end(), {kShiftUp, kShiftDown, kDrivenWay, kIdealWay, kBeamNode, kBeamEndNode});
  if (config.hand) names.insert(names.end(), {"HandRoot", "GhostHand"});
  for (std::string& name : Roadside::moving_names()) names.push_back(std::move(name));
  if (config.cutaway) {
    for (std::string& name : Gearbox::moving_names(config.gate)) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

std::vector<std::string> outdoor_names() {
  std::vector<std::string> names = Roadside::moving_names();
  names.emplace_back(kBodywork);
  return names;
}

Model make_stage_model(const StageConfig& config, const std::filesystem::path& folder) {
  Model model = read_gltf(folder / "cabin.glb");
  join_draws(model);
  gather_bodywork(model);
  draw_knob_cap(model, config.gate);
  if (config.open_gate) {
    open_the_gate(model, config);
  } else {
    add_lever_lamp(model, Node(node_of(model, "GatePlate")), above(kLamp, 0.0));
  }
  join_lever(model);
  add_shift_light(model);
  add_way(model, kDrivenWay, pivot_at_rest(model), kDrivenLook);
  add_way(model, kIdealWay, pivot_at_rest(model), kIdealLook);
  add_ghost(model);
  if (config.hand) Hand::add_to(model, read_gltf(folder / "hand.glb"), knob_at_rest(model));
  Roadside::add_to(model, road_things(config, folder));
  if (config.cutaway) Gearbox::add_to(model, gearbox_parts(config, folder), config.gate);
  if (config.drive == DriveSide::right) sit_on_the_right(model);
  add_pointer_beam(model);
  const std::vector<std::string> names = moving_names(config);
  return merge_static(model, std::vector<std::string_view>(names.begin(), names.end()));
}

}  // namespace gearshift
