#include "app/cabin/stage/gearbox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <glm/gtc/quaternion.hpp>

#include "app/cabin/stage/mesh_parts.h"
#include "app/cabin/stage/strokes.h"
#include "engine/model/assemble.h"

namespace gearshift::cabin {
namespace {

constexpr glm::vec3 kPlace{0.70f, 0.19f, -0.42f};  // [m] in cabin coordinates, in front of the passenger's knees
constexpr double kMaxWidth = 0.54;                 // [m] width available at kPlace
constexpr double kFingerReach = 0.030;             // [m] from the selector finger's axis to the middle of its tip
constexpr double kRingTravel = 0.0005;             // [m] travel of the ring until the cone grips
constexpr double kKeysMeet = 0.003;                // [m] sleeve travel at which the keys begin to press on the ring
constexpr double kTurnPerMetre = 0.5;              // [rad/m] hub rotation per metre driven, slow enough to watch
constexpr double kTurnPerTurn = 0.02;              // [1] turns of a free gear with ratio 1 per turn of the engine
constexpr double kMaxStep = 0.1;                   // [s] maximum time step from frame to frame
constexpr double kGearSign = 0.030;                // [m] height of a gear's label
constexpr const char* kEndName[2] = {"Forward", "Back"};
constexpr double kDirection[2] = {1.0, -1.0};  // sign of each end's direction along the shift axis

const haptics::Slot* slot_at(const haptics::Gate& gate, int column, int end) {
  const haptics::Column& c = haptics::column_of(gate, column);
  const int slot = end == 0 ? c.forward_slot : c.back_slot;
  return slot == haptics::kNoSlot ? nullptr : &haptics::slot_of(gate, slot);
}

std::vector<MeshPart> both(const engine::Model& model, const char* a, const char* b) {
  std::vector<MeshPart> parts = parts_of(model, required_node(model, a));
  for (MeshPart& part : parts_of(model, required_node(model, b))) parts.push_back(std::move(part));
  return parts;
}

// Adds a material that can replace all single-sided ones and returns its index. Metallic and roughness values go to a
// texture with one texel per replaced material, packed as in glTF (roughness green, metallic blue); colours go to the
// vertices, see use_shared_material().
int add_shared_material(engine::Model& box) {
  engine::Texture surfaces;
  surfaces.pixels.width = static_cast<int>(box.materials.size());
  surfaces.pixels.height = 1;
  for (const engine::Material& material : box.materials) {
    for (const float value : {1.0f, material.roughness, material.metallic, 1.0f}) {
      surfaces.pixels.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0f * value)));
    }
  }
  surfaces.wrap_u = surfaces.wrap_v = engine::Wrap::clamp;
  box.textures.push_back(std::move(surfaces));
  engine::Material shared;
  shared.name = "GearboxParts";
  shared.metal_rough_map.texture = static_cast<int>(box.textures.size()) - 1;
  box.materials.push_back(std::move(shared));
  return static_cast<int>(box.materials.size()) - 1;
}

void use_shared_material(engine::Model& box) {
  const auto count = static_cast<float>(box.materials.size());
  const int shared = add_shared_material(box);
  for (std::size_t i = 0; i < box.nodes.size(); ++i) {
    std::vector<MeshPart> parts = parts_of(box, static_cast<int>(i));
    if (parts.empty()) continue;
    for (MeshPart& part : parts) {
      const engine::Material& original = box.materials[static_cast<std::size_t>(part.material)];
      if (original.double_sided) continue;
      for (engine::Vertex& vertex : part.mesh_data.vertices) {
        vertex.colour = linear_rgba(glm::vec3(original.base_colour));
        vertex.uv0 = {(static_cast<float>(part.material) + 0.5f) / count, 0.5f};
      }
      part.material = shared;
    }
    set_parts(box, static_cast<int>(i), parts);
  }
}

// Merges parts that move together into one mesh, which reduces the number of draws.
void join_parts(engine::Model& box) {
  set_parts(box, required_node(box, "Rail"), both(box, "Rail", "Fork"));
  set_parts(box, required_node(box, "Hub"), both(box, "Hub", "Shaft"));
  use_shared_material(box);
}

int add_group(engine::Model& model, std::string name, glm::vec3 translation, int parent) {
  engine::Node node;
  node.name = std::move(name);
  node.translation = translation;
  node.parent = parent;
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

// Adds the number of a gear. It floats at the gear's end of the set, higher at the front end than at the rear end. So
// the gears hide neither number when the user looks down from the seat.
void add_sign(MeshData& ink, const haptics::Slot& slot, double x) {
  const double direction = static_cast<int>(slot.side);
  for (const Stroke& stroke :
       gear_label(slot.gear, {x, direction * 0.095}, kGearSign, 0.16 * kGearSign, glm::vec3(1.0f))) {
    add_flat(ink, stroke_triangles(stroke), direction > 0.0 ? 0.075 : -0.060, 0xffffffffu);
  }
}

glm::quat turned_about(glm::vec3 axis, double angle) {
  return glm::angleAxis(static_cast<float>(std::remainder(angle, 2.0 * std::numbers::pi)), axis);
}

}  // namespace

double set_x(const haptics::Gate& gate, int column) noexcept {
  return kSetDistance * (column - 0.5 * (gate.column_count - 1));
}

double rail_shift(const haptics::Gate& gate, int column, glm::dvec2 lever) noexcept {
  if (haptics::nearest_column(gate, lever.x) != column) return 0.0;
  const haptics::Slot* slot = slot_at(gate, column, lever.y > 0.0 ? 0 : 1);
  if (slot == nullptr) return 0.0;
  const double travel = (std::abs(lever.y) - gate.half_aisle) / (slot->rest - gate.half_aisle);
  return std::copysign(kRailTravel * std::clamp(travel, 0.0, 1.0), lever.y);
}

double finger_x(const haptics::Gate& gate, double select) noexcept {
  const int last = gate.column_count - 1;
  if (select <= haptics::column_of(gate, 0).center) return set_x(gate, 0);
  for (int i = 0; i < last; ++i) {
    const double a = haptics::column_of(gate, i).center, b = haptics::column_of(gate, i + 1).center;
    if (select <= b) return set_x(gate, i) + kSetDistance * (select - a) / (b - a);
  }
  return set_x(gate, last);
}

void Gearbox::add_to(engine::Model& model, const engine::Model& gear_model, const haptics::Gate& gate) {
  engine::Model box = gear_model;
  join_parts(box);
  for (const char* name : {"Fork", "Shaft"})
    box.nodes[static_cast<std::size_t>(required_node(box, name))].mesh = engine::kNone;
  const int first = engine::append_model(model, box);
  const auto end = static_cast<int>(model.nodes.size());
  const int root = required_node(model, "Gearbox");
  engine::Node& top = model.nodes[static_cast<std::size_t>(root)];
  top.translation = kPlace;
  top.scale = glm::vec3(static_cast<float>(std::min(1.0, kMaxWidth / (kSetDistance * gate.column_count))));

  MeshData ink;
  for (int column = 0; column < gate.column_count; ++column) {
    const std::string number = std::to_string(column);
    const double x = set_x(gate, column);
    const int set = add_group(model, "GearboxSet" + number, {static_cast<float>(x), 0.0f, 0.0f}, root);
    for (int i = first; i < end; ++i) {
      const engine::Node& node = model.nodes[static_cast<std::size_t>(i)];
      if (node.mesh == engine::kNone || node.name == "Finger") continue;
      bool is_there = true;
      for (int k = 0; k < 2; ++k) {
        const bool of_end =
            node.name == std::string("Gear") + kEndName[k] || node.name == std::string("Ring") + kEndName[k];
        if (of_end && slot_at(gate, column, k) == nullptr) is_there = false;
      }
      if (is_there) add_twin(model, i, node.name + number, set);
    }
    for (int k = 0; k < 2; ++k) {
      if (const haptics::Slot* slot = slot_at(gate, column, k)) add_sign(ink, *slot, x);
    }
  }
  for (int i = first; i < end; ++i) {
    engine::Node& node = model.nodes[static_cast<std::size_t>(i)];
    if (node.name != "Finger" || gate.column_count == 0)
      node.mesh = engine::kNone;  // hides the originals from which the sets were copied
  }
  if (gate.column_count == 0) return;  // a gate of aisles moves no rails
  engine::Material white;
  white.name = "GearboxInk";
  white.metallic = 0.0f;
  white.roughness = 0.6f;
  white.emissive = glm::vec3(0.35f);
  model.materials.push_back(white);
  const std::array<MaterialPart, 1> parts{MaterialPart{ink, static_cast<int>(model.materials.size()) - 1}};
  add_mesh_node(model, "GearboxSigns", parts, glm::vec3(0.0f), root);
}

std::vector<std::string> Gearbox::moving_names(const haptics::Gate& gate) {
  std::vector<std::string> names{"Finger"};
  for (int column = 0; column < gate.column_count; ++column) {
    const std::string number = std::to_string(column);
    for (const char* name : {"Rail", "Sleeve", "Hub"}) names.push_back(name + number);
    for (int k = 0; k < 2; ++k) {
      if (slot_at(gate, column, k) == nullptr) continue;
      names.push_back(std::string("Gear") + kEndName[k] + number);
      names.push_back(std::string("Ring") + kEndName[k] + number);
    }
  }
  return names;
}

Gearbox::Gearbox(const engine::Model& model, const haptics::Gate& gate)
    : rest_(model.nodes), finger_(required_node(model, "Finger")) {
  for (int column = 0; column < gate.column_count; ++column) {
    const std::string number = std::to_string(column);
    Set set;
    set.rail = required_node(model, "Rail" + number);
    set.sleeve = required_node(model, "Sleeve" + number);
    set.hub = required_node(model, "Hub" + number);
    for (int k = 0; k < 2; ++k) {
      if (slot_at(gate, column, k) == nullptr) continue;
      set.gear[k] = required_node(model, std::string("Gear") + kEndName[k] + number);
      set.ring[k] = required_node(model, std::string("Ring") + kEndName[k] + number);
    }
    sets_.push_back(set);
  }
}

void Gearbox::place(const haptics::Gate& gate, glm::dvec2 lever, const vehicle::VehicleState& car, double time,
                    std::vector<engine::Node>& pose) {
  const double step = std::clamp(time - time_, 0.0, kMaxStep);
  time_ = time;
  hub_angle_ = kTurnPerMetre * std::fmod(car.distance, 4.0 * std::numbers::pi / kTurnPerMetre);
  const auto node = [&](int index) -> engine::Node& { return pose[static_cast<std::size_t>(index)]; };
  double finger_shift = 0.0;
  for (int column = 0; column < gate.column_count; ++column) {
    Set& set = sets_[static_cast<std::size_t>(column)];
    const double shift = rail_shift(gate, column, lever);
    if (shift != 0.0) finger_shift = shift;
    const glm::vec3 along(0.0f, 0.0f, static_cast<float>(-shift));
    const glm::quat turned = turned_about({0.0f, 0.0f, 1.0f}, hub_angle_);
    node(set.rail).translation = rest_[static_cast<std::size_t>(set.rail)].translation + along;
    node(set.sleeve).translation = rest_[static_cast<std::size_t>(set.sleeve)].translation + along;
    node(set.sleeve).rotation = node(set.hub).rotation = turned;
    turn_gears(gate, column, shift, car, step, set, pose);
  }
  if (gate.column_count == 0) return;
  const auto across = static_cast<float>(finger_x(gate, lever.x));
  node(finger_).translation = rest_[static_cast<std::size_t>(finger_)].translation + glm::vec3(across, 0.0f, 0.0f);
  node(finger_).rotation = turned_about({1.0f, 0.0f, 0.0f}, std::asin(finger_shift / kFingerReach));
}

// Turns the gears and rings of a set. A free gear turns with the engine. Once the sleeve meets the gear's dogs, the
// gear turns with the hub, at an angle at which the sleeve's teeth fit into the gear's gaps.
void Gearbox::turn_gears(const haptics::Gate& gate, int column, double shift, const vehicle::VehicleState& car,
                         double step, Set& set, std::vector<engine::Node>& pose) {
  constexpr double kPitch = 2.0 * std::numbers::pi / kDogTeeth;
  constexpr double kDogsMeet = 0.007;  // [m] sleeve travel at which the dogs meet
  for (int k = 0; k < 2; ++k) {
    const haptics::Slot* slot = slot_at(gate, column, k);
    if (slot == nullptr) continue;
    const double travel = kDirection[k] * shift;
    double& angle = set.gear_angle[k];
    if (travel >= kDogsMeet) {
      angle = hub_angle_ + kPitch * std::round((angle - hub_angle_) / kPitch);
    } else {
      const double ratio = slot->gear == haptics::kReverseGear ? -0.6 : 0.5 + 0.15 * slot->gear;
      angle = std::remainder(angle + step * kTurnPerTurn * ratio * car.engine_speed, 2.0 * std::numbers::pi);
    }
    const double pressed = kRingTravel * std::clamp((travel - kKeysMeet) / 0.002, 0.0, 1.0);
    const auto ring = static_cast<std::size_t>(set.ring[k]);
    pose[static_cast<std::size_t>(set.gear[k])].rotation = turned_about({0.0f, 0.0f, 1.0f}, angle);
    pose[ring].rotation = turned_about({0.0f, 0.0f, 1.0f}, hub_angle_);
    pose[ring].translation =
        rest_[ring].translation + glm::vec3(0.0f, 0.0f, static_cast<float>(-kDirection[k] * pressed));
  }
}

}  // namespace gearshift::cabin
