#include "app/cabin/stage/gearbox.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/model/gltf.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

struct BoxRig {
  haptics::Gate gate;
  engine::Model model;
  std::vector<engine::Node> pose;

  explicit BoxRig(const std::string& name) : gate(shipped_gate(name)) {
    cabin::Gearbox::add_to(model, engine::read_gltf(GEARSHIFT_ASSETS "/models/gearbox.glb"), gate);
    pose = model.nodes;
  }
  const engine::Node& node(const std::string& name) const {
    const int index = model.node(name);
    REQUIRE(index != engine::kNone);
    return pose[static_cast<std::size_t>(index)];
  }
  double moved(const std::string& name) const {  // [m] displacement; forward is positive
    return -static_cast<double>(
        (node(name).translation - model.nodes[static_cast<std::size_t>(model.node(name))].translation).z);
  }
  double angle(const std::string& name) const {  // [rad] rotation about the shaft
    const glm::quat q = node(name).rotation;
    return 2.0 * std::atan2(static_cast<double>(q.z), static_cast<double>(q.w));
  }
};

}  // namespace

TEST_CASE("in every gear of every gate one sleeve moves 9 mm towards that gear, and no other sleeve moves") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    BoxRig rig(name);
    cabin::Gearbox box(rig.model, rig.gate);
    for (const haptics::Slot& slot : haptics::slots(rig.gate)) {
      box.place(rig.gate, haptics::rest_position(rig.gate, slot.gear), {}, 0.0, rig.pose);
      for (int column = 0; column < rig.gate.column_count; ++column) {
        const double wanted = column == slot.column ? 0.009 * static_cast<int>(slot.side) : 0.0;
        CHECK(rig.moved("Sleeve" + std::to_string(column)) == doctest::Approx(wanted));
        CHECK(rig.moved("Rail" + std::to_string(column)) == doctest::Approx(wanted));
      }
    }
    box.place(rig.gate, haptics::rest_position(rig.gate, haptics::kNeutralGear), {}, 0.0, rig.pose);
    for (int column = 0; column < rig.gate.column_count; ++column) {
      CHECK(rig.moved("Sleeve" + std::to_string(column)) == 0.0);
    }
  }
}

TEST_CASE("every moving part of the gearbox is drawn by one call and keeps the material of its file") {
  const engine::Model file = engine::read_gltf(GEARSHIFT_ASSETS "/models/gearbox.glb");
  const BoxRig rig("paper");
  const auto mesh_of = [](const engine::Model& model, const std::string& node) -> const engine::Mesh& {
    return model.meshes[static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(model.node(node))].mesh)];
  };
  for (const std::string& name : cabin::Gearbox::moving_names(rig.gate)) {
    CAPTURE(name);
    CHECK(mesh_of(rig.model, name).primitives.size() == 1);
  }
  // The forward ring's triangles have the colour, metalness and roughness of the file's material, rounded to 8 bits.
  const engine::Primitive& original = mesh_of(file, "RingForward").primitives.front();
  const engine::Primitive& drawn = mesh_of(rig.model, "RingForward0").primitives.front();
  const engine::Material& brass = file.materials[static_cast<std::size_t>(original.material)];
  const engine::Material& shared = rig.model.materials[static_cast<std::size_t>(drawn.material)];
  const engine::Image& surfaces = rig.model.textures[static_cast<std::size_t>(shared.metal_rough_map.texture)].pixels;
  REQUIRE(drawn.index_count == original.index_count);
  REQUIRE(brass.name == "Brass");
  for (std::uint32_t i = 0; i < drawn.index_count; ++i) {
    const engine::Vertex& vertex = rig.model.vertices[rig.model.indices[drawn.first_index + i]];
    const std::uint8_t* texel = surfaces.pixel(static_cast<int>(vertex.uv0.x * static_cast<float>(surfaces.width)), 0);
    CHECK(shared.roughness * static_cast<float>(texel[1]) / 255.0f == doctest::Approx(brass.roughness).epsilon(0.01));
    CHECK(shared.metallic * static_cast<float>(texel[2]) / 255.0f == doctest::Approx(brass.metallic).epsilon(0.01));
    for (int k = 0; k < 3; ++k) {
      const auto channel = static_cast<float>((vertex.colour >> (8 * k)) & 0xffu) / 255.0f;
      CHECK(std::abs(shared.base_colour[k] * channel - brass.base_colour[k]) < 0.003f);
    }
  }
}

TEST_CASE("between aisle and rest position the rail moves in proportion to the lever") {
  const haptics::Gate gate = paper_gate();
  const haptics::Slot& slot = haptics::slot_of(gate, haptics::slot_of_gear(gate, 4));
  const double x = haptics::column_of(gate, slot.column).center;
  for (const double fraction : {0.0, 0.25, 0.5, 1.0, 1.2}) {
    const double depth = gate.half_aisle + fraction * (slot.rest - gate.half_aisle);
    CHECK(cabin::rail_shift(gate, slot.column, {x, -depth}) == doctest::Approx(-0.009 * std::min(fraction, 1.0)));
  }
  CHECK(cabin::rail_shift(gate, slot.column, {x, 0.5 * gate.half_aisle}) == 0.0);
}

TEST_CASE("the finger is at the rail of the lever's column, and its tip moves with that rail") {
  BoxRig rig("six_speed_r_left_up");
  cabin::Gearbox box(rig.model, rig.gate);
  const double at_rest = static_cast<double>(rig.node("Finger").translation.x);
  for (const haptics::Slot& slot : haptics::slots(rig.gate)) {
    box.place(rig.gate, haptics::rest_position(rig.gate, slot.gear), {}, 0.0, rig.pose);
    const engine::Node& set = rig.node("GearboxSet" + std::to_string(slot.column));
    CHECK(static_cast<double>(rig.node("Finger").translation.x) - at_rest ==
          doctest::Approx(static_cast<double>(set.translation.x)));
    const glm::vec3 tip = rig.node("Finger").rotation * glm::vec3(0.0f, -0.030f, 0.0f);
    CHECK(-static_cast<double>(tip.z) == doctest::Approx(0.009 * static_cast<int>(slot.side)).epsilon(1e-4));
  }
  // Midway between two columns, the finger is midway between their rails.
  const double half = 0.5 * (haptics::column_of(rig.gate, 1).center + haptics::column_of(rig.gate, 2).center);
  CHECK(cabin::finger_x(rig.gate, half) ==
        doctest::Approx(0.5 * (cabin::set_x(rig.gate, 1) + cabin::set_x(rig.gate, 2))));
}

TEST_CASE("an engaged gear turns with the hub, with its teeth in the gaps; a free gear turns with the engine") {
  BoxRig rig("paper");
  cabin::Gearbox box(rig.model, rig.gate);
  vehicle::VehicleState car;
  car.engine_speed = 300.0;
  double last_free = 0.0;
  for (int i = 0; i < 200; ++i) {
    car.distance = 0.37 * i;
    box.place(rig.gate, haptics::rest_position(rig.gate, 3), car, 0.02 * i, rig.pose);
    const double slip = (rig.angle("GearForward1") - rig.angle("Hub1")) / (2.0 * kHalfTurn / 30.0);
    CHECK(std::abs(slip - std::round(slip)) < 1e-3);
    CHECK(std::abs(std::remainder(rig.angle("Sleeve1") - rig.angle("Hub1"), 2.0 * kHalfTurn)) < 1e-5);
    const double free = rig.angle("GearBack1");
    if (i > 0)
      CHECK(std::remainder(free - last_free, 2.0 * kHalfTurn) ==
            doctest::Approx(0.02 * 0.02 * (0.5 + 0.15 * 4) * 300.0).epsilon(1e-3));
    last_free = free;
  }
  // The hub turns with the distance driven, not with time.
  const double before = rig.angle("Hub1");
  box.place(rig.gate, haptics::rest_position(rig.gate, 3), car, 10.0, rig.pose);
  CHECK(std::abs(std::remainder(rig.angle("Hub1") - before, 2.0 * kHalfTurn)) < 1e-6);
}

TEST_CASE("every gear of a gate has a gear wheel and a ring, and a slot without a gear has none") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    BoxRig rig(name);
    for (int column = 0; column < rig.gate.column_count; ++column) {
      const haptics::Column& c = haptics::column_of(rig.gate, column);
      const std::string number = std::to_string(column);
      CHECK((rig.model.node("GearForward" + number) != engine::kNone) == (c.forward_slot != haptics::kNoSlot));
      CHECK((rig.model.node("RingForward" + number) != engine::kNone) == (c.forward_slot != haptics::kNoSlot));
      CHECK((rig.model.node("GearBack" + number) != engine::kNone) == (c.back_slot != haptics::kNoSlot));
      CHECK((rig.model.node("RingBack" + number) != engine::kNone) == (c.back_slot != haptics::kNoSlot));
    }
  }
}

}  // namespace gearshift::test
