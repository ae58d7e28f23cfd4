#include "app/cabin/stage/stage_model.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "app/cabin/stage/door_mirror.h"
#include "app/cabin/stage/gate_plate.h"
#include "app/cabin/stage/gearbox.h"
#include "app/cabin/stage/hand.h"
#include "app/cabin/stage/instruments.h"
#include "app/cabin/stage/lever_pose.h"
#include "app/cabin/stage/mesh_parts.h"
#include "app/cabin/stage/mirror_image.h"
#include "app/cabin/stage/path_ribbon.h"
#include "app/cabin/stage/pointer_beam.h"
#include "app/cabin/stage/roadside.h"
#include "app/cabin/stage/shift_light.h"
#include "app/cabin/stage/strokes.h"
#include "engine/model/assemble.h"
#include "engine/model/gltf.h"

namespace gearshift::cabin {
namespace {

constexpr glm::vec3 kCapGround{0.012f}, kCapInk{0.75f}, kCapReverse{0.62f, 0.035f, 0.025f};  // linear colours
constexpr int kCapSide = 256;               // [px] side length of the cap's texture
constexpr float kModelRod = 0.006f;         // [m] radius of LeverRod in the cabin model
constexpr glm::dvec2 kLamp{-0.052, 0.059};  // [m] on the boot's frame, front left, where the hand does not hide it
constexpr double kLampRadius = 0.0040;      // [m]
constexpr const char* kBodywork = "Bodywork";
constexpr std::array kPedals{"PedalClutch", "PedalBrake", "PedalThrottle"};

// Nodes that are moved but not mirrored to make a right-hand-drive car: print, controls, moving parts.
constexpr std::string_view kUpright[] = {
    "Cluster",    "RadioScreen",   "ClimatePrint", "HazardButton", "SteeringColumn", "PedalClutch",
    "PedalBrake", "PedalThrottle", "LeverPivot",   "GhostPivot",   "Boot",           "GatePlate",
    "BootRing",   "GateInsert",    kDrivenPath,    kIdealPath,     "Gearbox"};

engine::Node& node_of(engine::Model& model, std::string_view name) {
  return model.nodes[static_cast<std::size_t>(required_node(model, name))];
}

void hide(engine::Model& model, std::string_view name) {
  node_of(model, name).mesh = engine::kNone;
}

// Reduces the number of draws without a visible effect: small faces get a different material that the same part already
// uses, and parts that turn about their own axis of symmetry become static.
void reduce_draws(engine::Model& cabin) {
  for (const char* pedal : kPedals) {
    replace_material(cabin, pedal, "PlasticHard", "PlasticSoft");
  }
  replace_material(cabin, "Handbrake", "PlasticGloss", "MetalSatin");
  replace_material(cabin, "SteeringWheel", "PlasticSoft", "PlasticHard");
  split_static_part(cabin, "TachNeedle", "PlasticGloss");
  split_static_part(cabin, "SpeedNeedle", "PlasticGloss");
  engine::Node& ring = node_of(cabin, "BootRing");  // becomes static, because unlike the boot it does not bend
  const engine::Node& boot = node_of(cabin, "Boot");
  ring.translation += boot.translation;
  ring.parent = boot.parent;
}

// Moves those parts of the cabin that are lit by the open sky into one mesh with a node of its own.
void gather_bodywork(engine::Model& cabin) {
  const std::vector<glm::mat4> world = engine::rest_pose(cabin);
  std::vector<MeshPart> parts;
  for (const char* name : {"Bonnet", "Wipers", "DoorMirrorLeftHousing", "DoorMirrorLeftSurface",
                           "DoorMirrorRightHousing", "DoorMirrorRightSurface"}) {
    const int node = required_node(cabin, name);
    for (MeshPart& part : transformed_parts(cabin, node, world[static_cast<std::size_t>(node)])) {
      if (std::string_view(name).ends_with("Surface")) make_convex(part.mesh_data);
      parts.push_back(std::move(part));
    }
    hide(cabin, name);
  }
  engine::Node bodywork;
  bodywork.name = kBodywork;
  cabin.nodes.push_back(std::move(bodywork));
  set_parts(cabin, static_cast<int>(cabin.nodes.size()) - 1, parts);
}

engine::Material plain_material(std::string name, glm::vec3 colour, float metallic, float roughness) {
  engine::Material material;
  material.name = std::move(name);
  material.base_colour = glm::vec4(colour, 1.0f);
  material.metallic = metallic;
  material.roughness = roughness;
  return material;
}

int add_material(engine::Model& model, engine::Material material) {
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

// Draws the shift pattern of the loaded gate on the knob's cap.
void draw_knob_cap(engine::Model& model, const haptics::Gate& gate) {
  engine::Texture texture;
  texture.pixels = draw_strokes(shift_pattern(gate, kCapInk, kCapReverse), kCapSide, kCapGround);
  texture.srgb = true;
  texture.wrap_u = texture.wrap_v = engine::Wrap::clamp;
  model.textures.push_back(std::move(texture));
  engine::Material& material = model.materials[static_cast<std::size_t>(required_material(model, "KnobCap"))];
  material = plain_material("KnobCap", glm::vec3(1.0f), 0.0f, 0.35f);
  material.base_colour_map.texture = static_cast<int>(model.textures.size()) - 1;
}

// Adds a red lamp next to the gate, where the driver looks when pushing too hard.
void add_lever_lamp(engine::Model& model, const engine::Node& plate, glm::vec3 offset) {
  engine::Material red = plain_material("LampLever", glm::vec3(0.25f, 0.01f, 0.01f), 0.0f, 0.25f);
  red.emissive = glm::vec3(1.5f, 0.03f, 0.02f);
  const int lit = add_material(model, red);
  MeshData lens;
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
    add_wall(lens, {ring[i + 1], height[i + 1]}, {ring[i], height[i]}, WallFace::from_right);
  }
  const std::array<MaterialPart, 1> parts{MaterialPart{lens, lit}};
  add_mesh_node(model, "LampLever", parts, plate.translation + offset, plate.parent);
}

// Adds the gate plate above the pivot as a static node, hides boot and frame, and makes the lever as thin as the slots
// require.
void add_open_gate(engine::Model& model, const StageConfig& config) {
  const GatePlate plate = make_gate_plate(config.gate, config.yoke);
  for (const char* name : {"Boot", "BootRing", "GatePlate"}) hide(model, name);
  const int metal = add_material(model, plain_material("GateMetal", glm::vec3(0.20f, 0.203f, 0.21f), 1.0f, 0.50f));
  const int ink = add_material(model, plain_material("GateInk", glm::vec3(1.0f), 0.0f, 0.95f));
  const engine::Node pivot = node_of(model, "LeverPivot");
  const std::array<MaterialPart, 3> parts{MaterialPart{plate.metal, metal}, MaterialPart{plate.ink, ink},
                                          MaterialPart{plate.plinth, required_material(model, "PlasticHard")}};
  add_mesh_node(model, "GateInsert", parts, pivot.translation, pivot.parent);
  add_lever_lamp(model, pivot, above(plate.lamp, kPlateHeight));
  const float thin = static_cast<float>(plate.opening.rod_radius) / kModelRod;
  node_of(model, "LeverRod").scale = glm::vec3(thin, 1.0f, thin);
}

// Merges rod, collar and knob. Call after add_open_gate(), which makes the rod thin.
void join_lever(engine::Model& model) {
  for (const char* part : {"LeverRod", "LeverCollar"}) merge_into(model, part, "Knob");
}

// Adds a second, translucent lever without a boot, which shows the lever point.
void add_ghost(engine::Model& model) {
  const int pivot = required_node(model, "LeverPivot");
  const int ghost = add_twin(model, pivot, "GhostPivot", model.nodes[static_cast<std::size_t>(pivot)].parent);
  const int knob = add_twin(model, required_node(model, "Knob"), "GhostKnob", ghost);
  add_twin(model, required_node(model, "KnobCap"), "GhostCap", knob);
}

glm::vec3 pivot_at_rest(const engine::Model& model) {
  return glm::vec3(engine::rest_pose(model)[static_cast<std::size_t>(required_node(model, "LeverPivot"))][3]);
}

glm::vec3 knob_at_rest(const engine::Model& model) {
  return pivot_at_rest(model) + glm::vec3(0.0f, static_cast<float>(kDrawnLever), 0.0f);
}

// Mirrors the cabin; call before static parts are merged. The pedals keep their order, with the clutch to the left of
// the brake. The mirrored footrest is next to the throttle, because the tunnel leaves no room on the other side. The
// footrest cannot be left out, because it hides a hole and a baked shadow in the floor.
void make_right_hand_drive(engine::Model& model) {
  mirror_model(model, static_cast<float>(kMirrorPlane), kUpright);
  for (const char* pedal : kPedals) {
    engine::Node& node = node_of(model, pedal);
    node.translation.x = -node.translation.x;
  }
}

// Reads the road's model. For a right-hand-drive car the sign is mirrored here and once more with the whole model, so
// that the sign stays readable.
engine::Model road_parts(const StageConfig& config, const std::filesystem::path& folder) {
  engine::Model road = engine::read_gltf(folder / "road.glb");
  if (config.drive == DriveSide::right) mirror_mesh(road, node_of(road, "Sign").mesh);
  return road;
}

engine::Model gearbox_parts(const StageConfig& config, const std::filesystem::path& folder) {
  engine::Model parts = engine::read_gltf(folder / "gearbox.glb");
  if (config.drive == DriveSide::right) mirror_model(parts, 0.0f, {});
  return parts;
}

std::vector<std::string> moving_names(const StageConfig& config) {
  std::vector<std::string> names = {
      "LeverPivot", "Boot",          "TachNeedle", "SpeedNeedle", "SteeringWheel",         "PedalClutch", "PedalBrake",
      "GearPanel",  "PedalThrottle", "Handbrake",  "GhostPivot",  "InteriorMirrorSurface", kBodywork};
  names.insert(names.end(), kLampNodes.begin(), kLampNodes.end());
  names.insert(names.end(), {kShiftUp, kShiftDown, kDrivenPath, kIdealPath, kBeamNode, kBeamEndNode});
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

engine::Model make_stage_model(const StageConfig& config, const std::filesystem::path& folder) {
  engine::Model model = engine::read_gltf(folder / "cabin.glb");
  reduce_draws(model);
  gather_bodywork(model);
  draw_knob_cap(model, config.gate);
  if (config.open_gate) {
    add_open_gate(model, config);
  } else {
    add_lever_lamp(model, engine::Node(node_of(model, "GatePlate")), above(kLamp, 0.0));
  }
  join_lever(model);
  add_shift_light(model);
  add_path(model, kDrivenPath, pivot_at_rest(model), kDrivenStyle);
  add_path(model, kIdealPath, pivot_at_rest(model), kIdealStyle);
  add_ghost(model);
  if (config.hand) Hand::add_to(model, engine::read_gltf(folder / "hand.glb"), knob_at_rest(model));
  Roadside::add_to(model, road_parts(config, folder));
  if (config.cutaway) Gearbox::add_to(model, gearbox_parts(config, folder), config.gate);
  if (config.drive == DriveSide::right) make_right_hand_drive(model);
  add_pointer_beam(model);
  const std::vector<std::string> names = moving_names(config);
  return engine::merge_static(model, std::vector<std::string_view>(names.begin(), names.end()));
}

}  // namespace gearshift::cabin
