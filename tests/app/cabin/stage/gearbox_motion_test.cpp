// The directions in which the parts of the cut-away gearbox model move.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/cabin/stage/gearbox.h"
#include "engine/model/gltf.h"
#include "tests/support/gates.h"

namespace gearshift::test {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

struct Box {
  haptics::Gate gate;
  engine::Model model;
  std::vector<engine::Node> pose;

  explicit Box(const std::string& name) : gate(shipped_gate(name)) {
    cabin::Gearbox::add_to(model, engine::read_gltf(GEARSHIFT_ASSETS "/models/gearbox.glb"), gate);
    pose = model.nodes;
  }
  const engine::Node& node(const std::string& name) const {
    REQUIRE(model.node(name) != engine::kNone);
    return pose[static_cast<std::size_t>(model.node(name))];
  }
  double angle(const std::string& name) const {  // [rad] rotation about the shaft
    const glm::quat q = node(name).rotation;
    return 2.0 * std::atan2(static_cast<double>(q.z), static_cast<double>(q.w));
  }
  // [m] The position of the part's centre along its shaft.
  double along(const std::string& name) const {
    const engine::Mesh& mesh = model.meshes[static_cast<std::size_t>(node(name).mesh)];
    float low = 1e9f, high = -1e9f;
    for (const engine::Primitive& primitive : mesh.primitives) {
      low = std::min(low, primitive.low.z);
      high = std::max(high, primitive.high.z);
    }
    return static_cast<double>(0.5f * (low + high) + node(name).translation.z);
  }
};

// The lever position at `fraction` of the way from the aisle to the slot's rest position.
glm::dvec2 on_the_way(const haptics::Gate& gate, const haptics::Slot& slot, double fraction) {
  const double depth = gate.half_aisle + fraction * (slot.rest - gate.half_aisle);
  return {haptics::column_of(gate, slot.column).center, static_cast<int>(slot.side) * depth};
}

std::string end_of(const haptics::Slot& slot) {
  return (slot.side == haptics::Side::forward ? "Forward" : "Back") + std::to_string(slot.column);
}

}  // namespace

TEST_CASE("the sleeve presses only its own gear's ring onto the cone, by half a millimetre") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    Box box(name);
    cabin::Gearbox gearbox(box.model, box.gate);
    gearbox.place(box.gate, haptics::rest_position(box.gate, haptics::kNeutralGear), {}, 0.0, box.pose);
    const std::vector<engine::Node> rest = box.pose;
    for (const haptics::Slot& slot : haptics::slots(box.gate)) {
      CAPTURE(slot.gear);
      const std::string end = end_of(slot);
      box.pose = rest;
      const double gap = std::abs(box.along("Gear" + end) - box.along("Ring" + end));
      double last = gap;
      for (const double fraction : {0.2, 0.4, 0.6, 0.8, 1.0}) {
        gearbox.place(box.gate, on_the_way(box.gate, slot, fraction), {}, 0.0, box.pose);
        const double now = std::abs(box.along("Gear" + end) - box.along("Ring" + end));
        CHECK(now <= last + 1e-7);  // the ring never moves away from its gear
        last = now;
      }
      CHECK(gap - last == doctest::Approx(0.0005).epsilon(1e-3));
      for (const haptics::Slot& other : haptics::slots(box.gate)) {
        if (other.gear == slot.gear) continue;
        const auto ring = static_cast<std::size_t>(box.model.node("Ring" + end_of(other)));
        CHECK(box.pose[ring].translation == rest[ring].translation);
      }
    }
  }
}

// A gear that is not engaged turns freely, in the direction in which it would turn the hub if it were engaged: forwards
// for the forward gears, backwards for reverse.
TEST_CASE("a free gear turns as the hub would if it drove the car, so reverse turns opposite to all others") {
  for (const std::string& name : shipped_names()) {
    CAPTURE(name);
    Box box(name);
    cabin::Gearbox gearbox(box.model, box.gate);
    const glm::dvec2 neutral = haptics::rest_position(box.gate, haptics::kNeutralGear);
    vehicle::VehicleState car;
    car.engine_speed = 100.0;
    gearbox.place(box.gate, neutral, car, 0.0, box.pose);
    const std::vector<engine::Node> before = box.pose;
    const auto turned = [&](const std::string& part) {
      const double now = box.angle(part);
      const glm::quat q = before[static_cast<std::size_t>(box.model.node(part))].rotation;
      return std::remainder(now - 2.0 * std::atan2(static_cast<double>(q.z), static_cast<double>(q.w)), kTurn);
    };
    gearbox.place(box.gate, neutral, car, 0.05, box.pose);
    double last = 0.0;
    for (int gear = 1; gear <= haptics::kMaxGear; ++gear) {
      const int slot = haptics::slot_of_gear(box.gate, gear);
      if (slot == haptics::kNoSlot) continue;
      const double angle = turned("Gear" + end_of(haptics::slot_of(box.gate, slot)));
      CHECK(angle > last);  // all forward gears turn forwards, higher gears faster
      last = angle;
    }
    const double reverse =
        turned("Gear" + end_of(haptics::slot_of(box.gate, haptics::slot_of_gear(box.gate, haptics::kReverseGear))));
    CHECK(reverse < 0.0);
    for (const double driven : {0.5, -0.5}) {  // [m] forwards, backwards
      car.distance = driven;
      gearbox.place(box.gate, neutral, car, 0.05, box.pose);
      CHECK(turned("Hub0") * driven > 0.0);
    }
  }
}

}  // namespace gearshift::test
