// Compares free_span() with a walk in small steps, on random gates.
#include "haptics/contact/free_span.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <doctest/doctest.h>

#include "app/lab/random_gates/random_layout.h"
#include "haptics/contact/proxy.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kStep = 20e-6;      // [m] step length of the walk
constexpr double kSpanSlack = 1e-9;  // [m]

// Independent check whether a point is in free space: in_free_space() checks the fixed walls, and the fields of
// `passage` are checked for the movable walls.
bool is_free(const Gate& gate, const Passage& passage, dvec2 p) {
  if (!in_free_space(gate, p, kSpanSlack)) return false;
  const double mouth = gate.half_aisle + gate.chamfer;
  const double across = std::abs(p.y);
  const bool in_aisle = across <= gate.half_aisle + kSpanSlack;
  const Column& column = column_of(gate, nearest_column(gate, p.x));
  const bool in_column = std::abs(p.x - column.center) <= column.half_width + kSpanSlack;
  if (!in_column && (p.x < passage.select_min - kSpanSlack || p.x > passage.select_max + kSpanSlack)) return false;
  if (in_aisle) return true;
  const int slot = p.y > 0.0 ? column.forward_slot : column.back_slot;
  if ((passage.closed >> slot & 1u) != 0 && across > mouth + kSpanSlack) return false;
  if (slot != passage.limited_slot || across <= mouth + kSpanSlack) return true;
  const double min_depth = passage.depth_min > mouth ? passage.depth_min : 0.0;
  return across >= min_depth - kSpanSlack && across <= passage.depth_max + kSpanSlack;
}

// Distance [m] that can be walked from the point in steps of kStep until the next step would leave free space.
double walk(const Gate& gate, const Passage& passage, dvec2 point, dvec2 step) {
  int steps = 0;
  while (is_free(gate, passage, point + static_cast<double>(steps + 1) * step)) ++steps;
  return steps * kStep;
}

void check_against_walk(const Gate& gate, const Passage& passage, dvec2 p) {
  CAPTURE(p.x);
  CAPTURE(p.y);
  const FreeSpan span = free_span(gate, passage, p);
  for (const int axis : {0, 1}) {
    CAPTURE(axis);
    dvec2 step{0.0, 0.0};
    step[axis] = kStep;
    REQUIRE(span.low[axis] <= p[axis]);
    REQUIRE(span.high[axis] >= p[axis]);
    REQUIRE(std::abs(span.high[axis] - p[axis] - walk(gate, passage, p, step)) <= 1.01 * kStep);
    REQUIRE(std::abs(p[axis] - span.low[axis] - walk(gate, passage, p, -step)) <= 1.01 * kStep);
  }
}

// If the point is in a slot, limits the depth there in a third of the calls. As in the loop, the point is between the
// limits.
void limit_depth(const Gate& gate, dvec2 p, std::mt19937_64& random, Passage& passage) {
  const int slot = slot_at(gate, p);
  if (slot == kNoSlot || random() % 3 != 0) return;
  const double depth = std::abs(p.y), part = 1e-3 * static_cast<double>(random() % 5);
  passage.limited_slot = slot;
  passage.depth_min = random() % 2 == 0 ? 0.0 : depth - part;
  passage.depth_max = depth + part;
}

}  // namespace

TEST_CASE("200 random gates, walls opening and closing: a span ends where a walk in small steps does") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    const Gate gate = compile_gate(random_layout(seed), kPaperWorkspace);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> x(-0.08, 0.08), y(-0.07, 0.07);
    Lockouts lockouts;
    for (int i = 0; i < 40; ++i) {
      const LockoutInputs in{random() % 2 == 0, random() % 2 == 0, static_cast<double>(random() % 10),
                             static_cast<int>(random() % 7) - 1};
      const dvec2 p = place_proxy(gate, {x(random), y(random)}).position;
      Passage passage = lockouts.update(gate, in, p);
      limit_depth(gate, p, random, passage);
      check_against_walk(gate, passage, p);
    }
  }
}

TEST_CASE("the paper's gate: a slot's width and length in a slot, the aisle's between slots, both where they cross") {
  const Gate gate = paper_gate();
  const Passage open = open_passage(gate);
  const Column& left = gate.column[0];
  const FreeSpan in_slot = free_span(gate, open, {left.center, 0.030});
  CHECK(in_slot.low.x == left.center - left.half_width);
  CHECK(in_slot.high.x == left.center + left.half_width);
  CHECK(in_slot.high.y == left.forward);
  CHECK(in_slot.low.y == left.back);
  const FreeSpan between = free_span(gate, open, {0.5 * (left.center + gate.column[1].center), 0.0});
  CHECK(between.low.x == gate.select_min);
  CHECK(between.high.x == gate.select_max);
  CHECK(between.low.y == -gate.half_aisle);
  CHECK(between.high.y == gate.half_aisle);
  const FreeSpan crossing = free_span(gate, open, {left.center, 0.0});
  CHECK(crossing.high.x == gate.select_max);
  CHECK(crossing.high.y == left.forward);
}
