#include "app/cabin/stage/gate_plate.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/lab/random_gates/random_layout.h"
#include "haptics/gate/aisle.h"
#include "haptics/gate/gate_description.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

namespace gearshift::test {
namespace {

constexpr haptics::YokeGeometry kYoke;
constexpr int kRandomLayouts = 50;

struct NamedGate {
  std::string name;
  haptics::Gate gate;
};

std::vector<NamedGate> all_gates() {
  std::vector<NamedGate> gates;
  for (const std::string& name : shipped_names()) gates.push_back({name, shipped_gate(name)});
  for (const char* name : kMechanisms) gates.push_back({name, shipped_gate(name)});
  for (std::uint64_t seed = 1; seed <= kRandomLayouts; ++seed) {
    gates.push_back(
        {"random " + std::to_string(seed), haptics::compile_gate(lab::random_layout(seed), kPaperWorkspace)});
  }
  return gates;
}

struct Flat {
  glm::dvec2 a, b, c;
};

// The plate's metal as seen from the pivot about which the rod turns: all triangles, projected from the pivot onto the
// plate's face.
std::vector<Flat> metal_from_pivot(const cabin::MeshData& metal) {
  std::vector<Flat> flats;
  const auto projected = [&](std::uint32_t index) {
    const glm::dvec3 p(metal.vertices[index].position);
    return glm::dvec2(p.x, -p.z) * (cabin::kPlateHeight / p.y);
  };
  for (std::size_t i = 0; i < metal.indices.size(); i += 3) {
    flats.push_back({projected(metal.indices[i]), projected(metal.indices[i + 1]), projected(metal.indices[i + 2])});
  }
  return flats;
}

double distance_to_edge(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length_2 = glm::dot(along, along);
  const double t = length_2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length_2, 0.0, 1.0) : 0.0;
  return glm::distance(p, a + t * along);
}

bool is_inside(glm::dvec2 p, const Flat& f) {
  const auto side = [&](glm::dvec2 a, glm::dvec2 b) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  const double s = side(f.a, f.b), t = side(f.b, f.c), u = side(f.c, f.a);
  return (s > 0.0 && t > 0.0 && u > 0.0) || (s < 0.0 && t < 0.0 && u < 0.0);
}

double distance_to_metal(const std::vector<Flat>& metal, glm::dvec2 p) {
  double nearest = 1.0;
  for (const Flat& f : metal) {
    if (is_inside(p, f)) return 0.0;
    nearest = std::min(
        {nearest, distance_to_edge(p, f.a, f.b), distance_to_edge(p, f.b, f.c), distance_to_edge(p, f.c, f.a)});
  }
  return nearest;
}

// The point where the straight line from the yoke's centre to the knob above gate point `p` crosses the plate. Computed
// from the lever's lean and azimuth angles.
glm::dvec2 crossing(glm::dvec2 p) {
  const double lean = std::asin(glm::length(p) / kYoke.radius);
  const double azimuth = std::atan2(p.y, p.x);
  return cabin::kPlateHeight * std::tan(lean) * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
}

// True if the rod can pass the wall point `p` only because the round rod rounds off a convex corner of the wall. At a
// right angle, the rod's centre passes at most (sqrt 2 - 1) times the rod's radius behind the corner.
bool is_behind_a_corner(const haptics::Gate& gate, const cabin::SlotOpening& opening, glm::dvec2 p) {
  const double deepest = (std::sqrt(2.0) - 1.0) * opening.widened * kYoke.radius / cabin::kPlateHeight;
  if (!haptics::in_free_space(gate, p, deepest + 0.0002)) return false;
  for (const haptics::WallInfo& wall : haptics::describe_gate(gate).walls) {
    for (const glm::dvec2 corner : {wall.from, wall.to}) {
      if (glm::distance(crossing(corner), crossing(p)) < opening.widened + 0.0002) return true;
    }
  }
  return false;
}

glm::dvec2 random_point(const haptics::Gate& gate, std::mt19937_64& dice) {
  const glm::dvec2 reach = haptics::half_extent(gate) + 0.004;
  std::uniform_real_distribution<double> x(-reach.x, reach.x), y(-reach.y, reach.y);
  return {x(dice), y(dice)};
}

}  // namespace

TEST_CASE("the lever's rod meets the plate's metal exactly where the gate has a wall, except for rounded corners") {
  // [m] Points closer to a wall than this, measured at the knob, are skipped. On the plate this margin is at least
  // 0.1 mm, which is more than the grid of the opening cuts off a corner.
  constexpr double kMargin = 0.0002;
  const int thinning = is_full_campaign() ? 1 : 4;
  int checked = 0, free = 0, rounded = 0;
  for (const NamedGate& named : all_gates()) {
    const bool shipped = named.name.rfind("random", 0) != 0;
    const cabin::GatePlate plate = cabin::make_gate_plate(named.gate, kYoke);
    const std::vector<Flat> metal = metal_from_pivot(plate.metal);
    std::mt19937_64 dice(7);
    for (int i = 0; i < (shipped ? 2000 : 200) / thinning; ++i) {
      const glm::dvec2 p = random_point(named.gate, dice);
      const bool surely_free = haptics::in_free_space(named.gate, p, -kMargin);
      const bool surely_wall = !haptics::in_free_space(named.gate, p, kMargin);
      if (!surely_free && !surely_wall) continue;
      const bool meets = distance_to_metal(metal, crossing(p)) < plate.opening.widened;
      CAPTURE(named.name);
      CAPTURE(p.x);
      CAPTURE(p.y);
      if (surely_wall && !meets && is_behind_a_corner(named.gate, plate.opening, p)) {
        ++rounded;
        continue;
      }
      if (surely_free == meets) CHECK(surely_free != meets);
      ++checked;
      free += surely_free ? 1 : 0;
    }
  }
  CHECK(checked > 15000 / thinning);
  CHECK(free > 4000 / thinning);
  CHECK(checked - free > 4000 / thinning);
  CHECK(rounded < checked / 50);
}

TEST_CASE("a leaning round rod fits everywhere: its section in the plate's plane is an ellipse, not a circle") {
  double max_ratio = 0.0;
  for (const NamedGate& named : all_gates()) {
    const cabin::GatePlate plate = cabin::make_gate_plate(named.gate, kYoke);
    for (const haptics::Slot& slot : haptics::slots(named.gate)) {
      const bool is_place = haptics::is_mechanism(named.gate);
      const glm::dvec2 p = is_place ? slot.at
                                    : glm::dvec2(haptics::column_of(named.gate, slot.column).center,
                                                 static_cast<int>(slot.side) * slot.end);
      const double lean = std::asin(glm::length(p) / kYoke.radius);
      CHECK(plate.opening.rod_radius / std::cos(lean) <= plate.opening.widened);
      max_ratio = std::max(max_ratio, plate.opening.rod_radius / std::cos(lean) / plate.opening.widened);
    }
  }
  CHECK(max_ratio > 0.9);  // the opening is hardly wider than necessary
}

TEST_CASE("every layout gives a plate without holes or slivers: closed except for its foot and its opening") {
  for (const NamedGate& named : all_gates()) {
    const cabin::GatePlate plate = cabin::make_gate_plate(named.gate, kYoke);
    CAPTURE(named.name);
    double area = 0.0;
    int bad = 0, turned = 0;
    for (std::size_t i = 0; i < plate.metal.indices.size(); i += 3) {
      const engine::Vertex& a = plate.metal.vertices[plate.metal.indices[i]];
      const engine::Vertex& b = plate.metal.vertices[plate.metal.indices[i + 1]];
      const engine::Vertex& c = plate.metal.vertices[plate.metal.indices[i + 2]];
      const glm::dvec3 cross = glm::cross(glm::dvec3(b.position - a.position), glm::dvec3(c.position - a.position));
      const double twice = glm::length(cross);
      if (!std::isfinite(twice)) ++bad;
      for (const engine::Vertex* v : {&a, &b, &c}) {
        if (std::abs(glm::length(v->normal) - 1.0f) > 1e-4f) ++bad;
        if (twice > 1e-10 && glm::dot(cross / twice, glm::dvec3(v->normal)) < 0.5) ++turned;
      }
      if (a.position.y == b.position.y && b.position.y == c.position.y) area += 0.5 * twice;
    }
    CHECK(bad == 0);
    CHECK(turned == 0);
    // The face's area must be its outline minus its hole and the bevel; otherwise a triangle is missing or overlaps
    // another.
    const double outline = cabin::signed_area(cabin::rounded_rectangle(plate.half - 0.0004, 0.0096, 6));
    const double hole = cabin::signed_area(plate.opening.loop);
    CHECK(hole > 0.0);
    CHECK(area < outline - hole);
    CHECK(area > outline - hole - 0.0005 * 0.8);  // the bevel takes at most 0.5 mm along 0.8 m of edge
    CHECK(plate.opening.rod_radius > 0.0002);
  }
}

TEST_CASE("every gear's label is on the plate's metal, at the end of its slot") {
  for (const NamedGate& named : all_gates()) {
    const cabin::GatePlate plate = cabin::make_gate_plate(named.gate, kYoke);
    const std::vector<Flat> metal = metal_from_pivot(plate.metal);
    CAPTURE(named.name);
    REQUIRE(plate.labels.size() == static_cast<std::size_t>(named.gate.slot_count));
    for (const cabin::PlateLabel& label : plate.labels) {
      CAPTURE(label.gear);
      const haptics::Slot& slot = haptics::slot_of(named.gate, haptics::slot_of_gear(named.gate, label.gear));
      if (haptics::is_mechanism(named.gate)) {
        CHECK(glm::distance(label.centre, crossing(slot.at)) < 0.022);
        continue;
      }
      const glm::dvec2 end =
          crossing({haptics::column_of(named.gate, slot.column).center, static_cast<int>(slot.side) * slot.end});
      CHECK(std::abs(label.centre.x - end.x) < 1e-9);
      CHECK((label.centre.y - end.y) * static_cast<int>(slot.side) > 0.5 * label.height + plate.opening.widened);
      CHECK(glm::distance(label.centre, end) < 0.0155);
    }
    CHECK(plate.half.x < 0.064);  // the plate fits onto its plinth
    CHECK(plate.half.y < 0.068);
    CHECK(distance_to_metal(metal, plate.lamp) == 0.0);
    std::size_t counted = 0;
    for (const engine::Vertex& v : plate.ink.vertices) {
      if (counted++ % 4 != 0 && !is_full_campaign()) continue;
      if (distance_to_metal(metal, {v.position.x, -v.position.z}) > 0.0) {
        CHECK(distance_to_metal(metal, {v.position.x, -v.position.z}) == 0.0);
      }
    }
  }
}

TEST_CASE("the mappings from knob to plate and from plate to knob are inverse") {
  std::mt19937_64 dice(3);
  std::uniform_real_distribution<double> x(-0.077, 0.077), y(-0.068, 0.068);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec2 p(x(dice), y(dice));
    CHECK(glm::distance(cabin::plate_point(kYoke, p, 0.05), 0.05 / cabin::kPlateHeight * crossing(p)) < 1e-12);
    CHECK(glm::distance(cabin::gate_point(kYoke, cabin::plate_point(kYoke, p, 0.05), 0.05), p) < 1e-12);
  }
}

}  // namespace gearshift::test
