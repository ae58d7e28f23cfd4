// Grows a layout part by part and keeps each part that the gate compiler accepts.
#include "app/lab/random_gates/random_mechanism.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "haptics/files/file_error.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

class Grower {
 public:
  explicit Grower(std::uint64_t seed) : engine_(seed) {
    layout_.name = "Random mechanism " + std::to_string(seed);
    layout_.file = "random_mechanism_" + std::to_string(seed) + ".toml";
  }

  void grow_tree() {
    const dvec2 from{between(-0.02, 0.02), between(-0.02, 0.02)};
    while (!begin(from, from + on_circle(between(0.025, 0.05)))) continue;
    for (int i = 0; i < 60 && layout_.aisles.size() < 7; ++i) {
      const haptics::AisleLayout& trunk = layout_.aisles[index(layout_.aisles.size())];
      const double part = coin() ? 1.0 : between(0.0, 1.0);
      const dvec2 at{trunk.from_x + part * (trunk.to_x - trunk.from_x),
                     trunk.from_y + part * (trunk.to_y - trunk.from_y)};
      add_aisle(at, at + on_circle(between(0.018, 0.045)));
    }
  }

  void grow_grid() {
    const double turn = between(0.0, 0.5 * std::numbers::pi), pitch = between(0.020, 0.026);
    const dvec2 u{std::cos(turn), std::sin(turn)}, v{-u.y, u.x};
    const int rows = 2 + static_cast<int>(index(2)), columns = 2 + static_cast<int>(index(2));
    const dvec2 corner = -0.5 * pitch * (static_cast<double>(columns - 1) * u + static_cast<double>(rows - 1) * v);
    width_ = between(0.005, 0.009);
    for (int i = 0; i < rows; ++i) {
      const dvec2 from = corner + pitch * i * v, to = from + pitch * (columns - 1) * u;
      if (layout_.aisles.empty())
        (void)begin(from, to);
      else
        lines_.push_back({from, to});
    }
    for (int i = 0; i < columns; ++i)
      add_aisle(corner + pitch * i * u, corner + pitch * i * u + pitch * (rows - 1) * v);
    for (const auto& [from, to] : lines_) add_aisle(from, to);
  }

  void add_parts() {
    for (int i = 0; i < 40 && layout_.places.size() < 9; ++i) add_place();
    for (std::size_t i = 0; i < layout_.aisles.size(); ++i)
      if (coin()) add_spring(i);
    if (coin()) attempt([&] { layout_.feel.center_force = between(2.5, 5.0); });
    for (int i = 0; i < 3; ++i) add_lockout();
  }

  haptics::GateLayout take() && { return std::move(layout_); }

 private:
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  bool coin() { return engine_() % 2 == 0; }
  dvec2 on_circle(double radius) {
    const double angle = between(0.0, 2.0 * std::numbers::pi);
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

  // The first aisle, with its ends as places.
  bool begin(dvec2 from, dvec2 to) {
    layout_.aisles = {aisle(from, to)};
    layout_.places = {place(from), place(to)};
    layout_.places[0].gear = haptics::kNeutralGear;
    layout_.feel.center_force = 0.0;
    return is_accepted();
  }

  haptics::AisleLayout aisle(dvec2 from, dvec2 to) {
    haptics::AisleLayout made;
    made.from_x = from.x, made.from_y = from.y, made.to_x = to.x, made.to_y = to.y;
    made.width = width_ > 0.0 ? width_ : between(0.005, 0.011);
    return made;
  }

  haptics::PlaceLayout place(dvec2 at) {
    haptics::PlaceLayout made;
    made.x = at.x, made.y = at.y;
    made.gear = haptics::kFirstPosition + next_gear_++;
    made.label = "P" + std::to_string(next_gear_);
    made.lock_force = between(4.0, 8.0);
    made.detent_force = between(0.0, 2.0);
    return made;
  }

  void add_aisle(dvec2 from, dvec2 to) {
    attempt([&] { layout_.aisles.push_back(aisle(from, to)); });
  }

  void add_place() {
    const haptics::AisleLayout& on = layout_.aisles[index(layout_.aisles.size())];
    const double part = coin() ? between(0.0, 1.0) : static_cast<double>(index(2));
    const dvec2 at{on.from_x + part * (on.to_x - on.from_x), on.from_y + part * (on.to_y - on.from_y)};
    attempt([&] { layout_.places.push_back(place(at)); });
  }

  void add_spring(std::size_t i) {
    attempt([&] {
      haptics::AisleLayout& on = layout_.aisles[i];
      on.spring_force = between(1.0, 3.0);
      on.spring_to = coin() ? 0.0 : between(0.0, std::hypot(on.to_x - on.from_x, on.to_y - on.from_y));
    });
  }

  void add_lockout() {
    attempt([&] {
      haptics::LockoutLayout lockout;
      lockout.gear = layout_.places[index(layout_.places.size())].gear;
      lockout.kind = coin() ? haptics::LockoutKind::push_down : haptics::LockoutKind::lift;
      lockout.is_leaving = coin();
      layout_.lockouts.push_back(lockout);
    });
  }

  void attempt(const auto& change) {
    const haptics::GateLayout before = layout_;
    change();
    if (!is_accepted()) layout_ = before;
  }

  bool is_accepted() const {
    constexpr haptics::YokeGeometry kYoke;
    try {
      (void)haptics::compile_gate(layout_, haptics::workspace_half_extent(kYoke), kYoke.radius);
      return true;
    } catch (const haptics::FileError&) {
      return false;
    }
  }

  std::mt19937_64 engine_;
  haptics::GateLayout layout_;
  std::vector<std::pair<dvec2, dvec2>> lines_;
  double width_ = 0.0;  // [m] of all aisles of a grid
  int next_gear_ = 0;
};

}  // namespace

haptics::GateLayout random_mechanism(std::uint64_t seed) {
  Grower grower(seed);
  if (seed % 2 == 1)
    grower.grow_tree();
  else
    grower.grow_grid();
  grower.add_parts();
  return std::move(grower).take();
}

}  // namespace gearshift::lab
