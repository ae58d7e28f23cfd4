#include "app/stage/gate_plate.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/gate/gate_description.h"
#include "tests/support/gates.h"
#include "tests/support/random_layout.h"
#include "tests/support/whole_campaign.h"

namespace gearshift {
namespace {

constexpr YokeGeometry kYoke;
constexpr int kRandomLayouts = 50;

struct NamedGate {
  std::string name;
  Gate gate;
};

std::vector<NamedGate> all_gates() {
  std::vector<NamedGate> gates;
  for (const std::string& name : shipped_names()) gates.push_back({name, shipped_gate(name)});
  for (std::uint64_t seed = 1; seed <= kRandomLayouts; ++seed) {
    gates.push_back({"random " + std::to_string(seed), compile_gate(random_layout(seed), kPaperWorkspace)});
  }
  return gates;
}

struct Flat {
  glm::dvec2 a, b, c;
};

// The metal as a rod sees it that comes from the pivot: all triangles of the plate in central projection on its face.
std::vector<Flat> metal_seen_from_pivot(const Patch& metal) {
  std::vector<Flat> flats;
  const auto seen = [&](std::uint32_t index) {
    const glm::dvec3 p(metal.vertices[index].position);
    return glm::dvec2(p.x, -p.z) * (kPlateHeight / p.y);
  };
  for (std::size_t i = 0; i < metal.indices.size(); i += 3) {
    flats.push_back({seen(metal.indices[i]), seen(metal.indices[i + 1]), seen(metal.indices[i + 2])});
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

// Where the straight line from the yoke's centre to the knob above a gate point crosses the plate, written with
// angles: tan(theta) = px / pz, pz = rho cos of the lever's lean.
glm::dvec2 crossing(glm::dvec2 p) {
  const double lean = std::asin(glm::length(p) / kYoke.radius);
  const double azimuth = std::atan2(p.y, p.x);
  return kPlateHeight * std::tan(lean) * glm::dvec2(std::cos(azimuth), std::sin(azimuth));
}

// A round rod rounds a convex corner of the metal: its centre passes a right angle within (sqrt 2 - 1) of its radius
// behind the corner. Can a wall point be passed for that reason?
bool is_behind_a_corner(const Gate& gate, const SlotOpening& opening, glm::dvec2 p) {
  const double deepest = (std::sqrt(2.0) - 1.0) * opening.widened * kYoke.radius / kPlateHeight;
  if (!in_free_space(gate, p, deepest + 0.0002)) return false;
  for (const WallInfo& wall : describe_gate(gate).walls) {
    for (const glm::dvec2 corner : {wall.from, wall.to}) {
      if (glm::distance(crossing(corner), crossing(p)) < opening.widened + 0.0002) return true;
    }
  }
  return false;
}

glm::dvec2 random_point(const Gate& gate, std::mt19937_64& dice) {
  double deepest = 0.0;
  for (const Slot& slot : slots(gate)) deepest = std::max(deepest, slot.end);
  const double margin = 0.004;
  std::uniform_real_distribution<double> x(gate.select_min - margin, gate.select_max + margin);
  std::uniform_real_distribution<double> y(-deepest - margin, deepest + margin);
  return {x(dice), y(dice)};
}

}  // namespace

TEST_CASE("the lever's rod meets the plate's metal exactly where the gate has a wall, but for rounded corners") {
  // 0.2 mm at the knob is at least 0.1 mm on the plate: more than a cell of the grid cuts off a corner.
  constexpr double kMargin = 0.0002;
  const int share = is_whole_campaign() ? 1 : 4;
  int checked = 0, free = 0, rounded = 0;
  for (const NamedGate& named : all_gates()) {
    const bool shipped = named.name.rfind("random", 0) != 0;
    const GatePlate plate = make_gate_plate(named.gate, kYoke);
    const std::vector<Flat> metal = metal_seen_from_pivot(plate.metal);
    std::mt19937_64 dice(7);
    for (int i = 0; i < (shipped ? 2000 : 200) / share; ++i) {
      const glm::dvec2 p = random_point(named.gate, dice);
      const bool surely_free = in_free_space(named.gate, p, -kMargin);
      const bool surely_wall = !in_free_space(named.gate, p, kMargin);
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
  CHECK(checked > 15000 / share);
  CHECK(free > 4000 / share);
  CHECK(checked - free > 4000 / share);
  CHECK(rounded < checked / 50);
}

TEST_CASE("a leaning round rod passes everywhere: its section with the plate is an ellipse, not a circle") {
  double most = 0.0;
  for (const NamedGate& named : all_gates()) {
    const GatePlate plate = make_gate_plate(named.gate, kYoke);
    for (const Slot& slot : slots(named.gate)) {
      const glm::dvec2 p(column_of(named.gate, slot.column).center, static_cast<int>(slot.side) * slot.end);
      const double lean = std::asin(glm::length(p) / kYoke.radius);
      CHECK(plate.opening.rod_radius / std::cos(lean) <= plate.opening.widened);
      most = std::max(most, plate.opening.rod_radius / std::cos(lean) / plate.opening.widened);
    }
  }
  CHECK(most > 0.9);  // and it is not wider than it has to be
}

TEST_CASE("every layout makes a plate without holes or slivers: closed but for its foot and its throat") {
  for (const NamedGate& named : all_gates()) {
    const GatePlate plate = make_gate_plate(named.gate, kYoke);
    CAPTURE(named.name);
    double area = 0.0;
    int bad = 0, turned = 0;
    for (std::size_t i = 0; i < plate.metal.indices.size(); i += 3) {
      const Vertex& a = plate.metal.vertices[plate.metal.indices[i]];
      const Vertex& b = plate.metal.vertices[plate.metal.indices[i + 1]];
      const Vertex& c = plate.metal.vertices[plate.metal.indices[i + 2]];
      const glm::dvec3 cross = glm::cross(glm::dvec3(b.position - a.position), glm::dvec3(c.position - a.position));
      const double twice = glm::length(cross);
      if (!std::isfinite(twice)) ++bad;
      for (const Vertex* v : {&a, &b, &c}) {
        if (std::abs(glm::length(v->normal) - 1.0f) > 1e-4f) ++bad;
        if (twice > 1e-10 && glm::dot(cross / twice, glm::dvec3(v->normal)) < 0.5) ++turned;
      }
      if (a.position.y == b.position.y && b.position.y == c.position.y) area += 0.5 * twice;
    }
    CHECK(bad == 0);
    CHECK(turned == 0);
    // The face is its outline less its hole: no triangle is missing, none lies on another.
    const double outline = signed_area(rounded_rectangle(plate.half - 0.0004, 0.0096, 6));
    const double hole = signed_area(plate.opening.loop);
    CHECK(hole > 0.0);
    CHECK(area < outline - hole);
    CHECK(area > outline - hole - 0.0005 * 0.8);  // less the bevel: 0.4 mm along at most 0.8 m of edge
    CHECK(plate.opening.rod_radius > 0.0002);
  }
}

TEST_CASE("every gear's sign stands on the plate at the end of its slot, on metal") {
  for (const NamedGate& named : all_gates()) {
    const GatePlate plate = make_gate_plate(named.gate, kYoke);
    const std::vector<Flat> metal = metal_seen_from_pivot(plate.metal);
    CAPTURE(named.name);
    REQUIRE(plate.marks.size() == static_cast<std::size_t>(named.gate.slot_count));
    for (const GearMark& mark : plate.marks) {
      CAPTURE(mark.gear);
      const Slot& slot = slot_of(named.gate, slot_of_gear(named.gate, mark.gear));
      const glm::dvec2 end =
          crossing({column_of(named.gate, slot.column).center, static_cast<int>(slot.side) * slot.end});
      CHECK(std::abs(mark.centre.x - end.x) < 1e-9);
      CHECK((mark.centre.y - end.y) * static_cast<int>(slot.side) > 0.5 * mark.height + plate.opening.widened);
      CHECK(glm::distance(mark.centre, end) < 0.0155);
    }
    CHECK(plate.half.x < 0.064);  // it stands on its plinth
    CHECK(plate.half.y < 0.068);
    CHECK(distance_to_metal(metal, plate.lamp) == 0.0);
    std::size_t counted = 0;
    for (const Vertex& v : plate.ink.vertices) {
      if (counted++ % 4 != 0 && !is_whole_campaign()) continue;
      if (distance_to_metal(metal, {v.position.x, -v.position.z}) > 0.0) {
        CHECK(distance_to_metal(metal, {v.position.x, -v.position.z}) == 0.0);
      }
    }
  }
}

TEST_CASE("both ways between knob and plate are inverse") {
  std::mt19937_64 dice(3);
  std::uniform_real_distribution<double> x(-0.077, 0.077), y(-0.068, 0.068);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec2 p(x(dice), y(dice));
    CHECK(glm::distance(plate_point(kYoke, p, 0.05), 0.05 / kPlateHeight * crossing(p)) < 1e-12);
    CHECK(glm::distance(gate_point(kYoke, plate_point(kYoke, p, 0.05), 0.05), p) < 1e-12);
  }
}

}  // namespace gearshift
