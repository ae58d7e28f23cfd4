// Compiles layouts to gates and checks positions, curves, lockouts and walls; then does the same for random valid
// layouts.
#include "haptics/gate/gate_compiler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "app/lab/random_gates/random_layout.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/gate_checks.h"
#include "haptics/gate/gate_description.h"
#include "tests/haptics/gate/gate_laws.h"
#include "tests/support/gates.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using doctest::Approx;
using glm::dvec2;

namespace {

constexpr int kRandomLayouts = 200;

const Slot& slot_for(const Gate& gate, int gear) {
  const int slot = slot_of_gear(gate, gear);
  REQUIRE(slot != kNoSlot);
  return slot_of(gate, slot);
}

const Slot& slot_for(const Gate&&, int) = delete;  // prevents a dangling reference to a slot of a temporary gate

int count_role(const GateDescription& list, WallRole role) {
  return static_cast<int>(
      std::count_if(list.walls.begin(), list.walls.end(), [&](const WallInfo& w) { return w.role == role; }));
}

// True if a point-like lever can reach every gear from neutral. Uses a flood fill on a 0.5 mm grid, which is
// independent of the compiler's aisles.
bool reaches_every_gear(const Gate& gate) {
  constexpr double step = 0.5e-3;
  constexpr int reach = 160;
  constexpr int width = 2 * reach + 1;
  std::vector<char> visited(static_cast<std::size_t>(width) * width, 0);
  const auto index = [](int i, int j) {
    return static_cast<std::size_t>(i + reach) * width + static_cast<std::size_t>(j + reach);
  };
  std::queue<std::pair<int, int>> front;
  const auto visit = [&](int i, int j) {
    if (std::abs(i) > reach || std::abs(j) > reach || visited[index(i, j)]) return;
    if (!in_free_space(gate, {i * step, j * step}, 1e-9)) return;
    visited[index(i, j)] = 1;
    front.emplace(i, j);
  };
  const auto cell = [&](double metres) { return static_cast<int>(std::lround(metres / step)); };
  const dvec2 neutral = rest_position(gate, kNeutralGear);
  visit(cell(neutral.x), 0);
  while (!front.empty()) {
    const auto [i, j] = front.front();
    front.pop();
    visit(i + 1, j), visit(i - 1, j), visit(i, j + 1), visit(i, j - 1);
  }
  const auto all = slots(gate);
  return std::all_of(all.begin(), all.end(), [&](const Slot& slot) {
    const dvec2 rest = rest_position(gate, slot.gear);
    return visited[index(cell(rest.x), cell(rest.y))] != 0;
  });
}

// True if the wall has free space on exactly one side.
bool separates(const Gate& gate, const WallInfo& wall) {
  const dvec2 middle = 0.5 * (wall.from + wall.to);
  const dvec2 along = wall.to - wall.from;
  const dvec2 across = 20e-6 / std::hypot(along.x, along.y) * dvec2(-along.y, along.x);
  return in_free_space(gate, middle + across) != in_free_space(gate, middle - across);
}

// Checks that the force's slope is at most 4000 N/m everywhere and does not jump. A cubic piece of at most 40 N over a
// length of at least 0.7 mm has a curvature of at most 6 * 40 N / (0.7 mm)^2; a kink would exceed this.
void check_smooth(const FeelCurve& curve, double from, double to) {
  constexpr double step = 1e-6;
  const double bend = 6.0 * 40.0 / (0.7e-3 * 0.7e-3);
  const int count = static_cast<int>((to - from) / step) - 1;
  for (int i = 0; i < count; ++i) {
    const double at = from + i * step;
    const double rise = feel_force(curve, at + step) - feel_force(curve, at);
    const double turn = feel_slope(curve, at + step) - feel_slope(curve, at);
    if (std::abs(rise) <= 4001.0 * step && std::abs(turn) <= bend * step) continue;
    FAIL("force jumps by ", rise, " N, slope by ", turn, " N/m at ", at * 1e3, " mm");
  }
}

// Checks that a slot has a single rest position away from its walls, and that the gear engages only where the slot
// pulls the lever in.
void check_lock(const Gate& gate, const Slot& slot) {
  CHECK(slot.release_depth < slot.engage_depth);
  CHECK(slot.engage_depth < slot.rest);
  CHECK(slot.rest < slot.end);
  double edge = slot.release_depth;
  while (edge < slot.rest && feel_force(slot.feel, edge) <= 0.0) edge += 1e-6;
  CHECK(edge > slot.release_depth);
  CHECK(edge < slot.engage_depth);
  const auto holds_between = [&](double from, double to, auto law) {
    constexpr int count = 200;
    for (int i = 1; i < count; ++i) {
      if (!law(feel_force(slot.feel, from + (to - from) * i / count))) return false;
    }
    return true;
  };
  CHECK(holds_between(gate.half_aisle, edge - 1e-6, [](double force) { return force <= 0.0; }));
  CHECK(holds_between(edge, slot.rest, [](double force) { return force > 0.0; }));
  CHECK(feel_force(slot.feel, slot.rest) == Approx(0.0));
  CHECK(holds_between(slot.rest, slot.end, [](double force) { return force < 0.0; }));
}

void check_places(const Gate& gate) {
  CHECK(gate.select_min == Approx(gate.column[0].center - gate.column[0].half_width));
  for (int i = 1; i < gate.column_count; ++i) {
    const Column& left = column_of(gate, i - 1);
    const Column& right = column_of(gate, i);
    CHECK(left.center + left.half_width + gate.chamfer < right.center - right.half_width - gate.chamfer);
  }
  for (const Slot& slot : slots(gate)) {
    const Column& column = column_of(gate, slot.column);
    CHECK(yoke_reaches({std::abs(column.center) + column.half_width + 0.0069, slot.end + 0.0069}));
    CHECK(in_free_space(gate, rest_position(gate, slot.gear)));
  }
}

void check_lockouts(const Gate& gate) {
  for (const Lockout& lockout : lockouts(gate)) {
    REQUIRE(lockout.slot >= 0);
    REQUIRE(lockout.slot < gate.slot_count);
    if (lockout.kind == LockoutKind::speed) CHECK(lockout.open_below < lockout.close_above);
    if (!lockout.lateral) continue;
    const Column& guarded_column = column_of(gate, slot_of(gate, lockout.slot).column);
    CHECK(lockout.beyond * (guarded_column.center - lockout.barrier) > guarded_column.half_width + gate.chamfer);
    CHECK(lockout.beyond * (rest_position(gate, kNeutralGear).x - lockout.barrier) < 0.0);
  }
}

void check_description(const Gate& gate) {
  const GateDescription list = describe_gate(gate);
  CHECK(list.aisles.size() == static_cast<std::size_t>(1 + gate.column_count));
  CHECK(list.junctions.size() == static_cast<std::size_t>(gate.column_count));
  CHECK(list.wall_pairs.size() == static_cast<std::size_t>(gate.column_count - 1 + gate.slot_count));
  CHECK(count_role(list, WallRole::end_stop) == gate.slot_count);
  std::vector<int> walls_of(list.wall_pairs.size(), 0);
  for (const WallInfo& wall : list.walls) {
    CAPTURE(wall.from.x);
    CAPTURE(wall.from.y);
    CHECK(separates(gate, wall));
    CHECK((wall.pair >= 0) == (wall.role == WallRole::aisle));
    if (wall.pair >= 0) ++walls_of.at(static_cast<std::size_t>(wall.pair));
  }
  CHECK(std::all_of(walls_of.begin(), walls_of.end(), [](int count) { return count == 2; }));
}

// A small layout that the tests modify. It has two columns: gears 1 and 2 on the left, where neutral is, and gears 3
// and R on the right.
GateLayout small_layout() {
  GateLayout layout;
  layout.file = "small.toml";
  layout.columns.resize(2);
  layout.columns[0].forward.gear = 1;
  layout.columns[0].back.gear = 2;
  layout.columns[1].position = 0.030;
  layout.columns[1].forward.gear = 3;
  layout.columns[1].back.gear = kReverseGear;
  return layout;
}

LockoutLayout guard(int gear, LockoutKind kind) {
  LockoutLayout lockout;
  lockout.gear = gear;
  lockout.kind = kind;
  return lockout;
}

}  // namespace

TEST_CASE("the paper's gate: one horizontal and three vertical aisles, three junctions, eight pairs of walls") {
  const GateDescription list = describe_gate(paper_gate());
  CHECK(std::count_if(list.aisles.begin(), list.aisles.end(), [](const AisleInfo& a) { return a.horizontal; }) == 1);
  CHECK(std::count_if(list.aisles.begin(), list.aisles.end(), [](const AisleInfo& a) { return !a.horizontal; }) == 3);

  REQUIRE(list.junctions.size() == 3);
  const auto& [first, second, third] = std::tie(list.junctions[0], list.junctions[1], list.junctions[2]);
  CHECK(first.name == "I");
  CHECK((!first.left && first.right && first.forward && first.back && first.buffer));
  CHECK(second.name == "II");
  CHECK((second.left && second.right && second.forward && second.back && !second.buffer));
  CHECK(third.name == "III");
  CHECK((third.left && !third.right && third.forward && third.back && third.buffer));

  REQUIRE(list.wall_pairs.size() == 8);
  const auto horizontal = [](const WallPairInfo& pair) { return pair.horizontal; };
  CHECK(std::count_if(list.wall_pairs.begin(), list.wall_pairs.end(), horizontal) == 2);
  CHECK(count_role(list, WallRole::aisle) == 16);
  CHECK(count_role(list, WallRole::end_stop) == 6);
  CHECK(count_role(list, WallRole::closed_side) == 2);
  CHECK(count_role(list, WallRole::chamfer) == 8);
}

TEST_CASE("the paper's gate has the positions given in its file") {
  const Gate gate = paper_gate();
  CHECK(gate.half_aisle == Approx(0.006));
  CHECK(gate.select_min == Approx(-0.035));
  CHECK(gate.select_max == Approx(0.035));
  CHECK(gate.neutral_column == 1);
  CHECK(rest_position(gate, 1).x == Approx(-0.030));
  CHECK(rest_position(gate, 1).y > 0.0);
  CHECK(rest_position(gate, kReverseGear).x == Approx(0.030));
  CHECK(rest_position(gate, kReverseGear).y < 0.0);

  REQUIRE(gate.buffer_count == 2);
  CHECK(gate.buffer[0].wall == Approx(-0.035));
  CHECK(gate.buffer[0].inner == Approx(-0.027));  // width of the buffer: 0.8 of the slot width of 10 mm
  CHECK(gate.buffer[1].wall == Approx(0.035));
  CHECK(gate.buffer[1].inner == Approx(0.027));
  CHECK((gate.buffer[1].back_open && gate.buffer[1].forward_open));
}

// The part of the slot behind the mouth extends from 10 to 40 mm. The knots of the curve are at the fractions 0.14,
// 0.28, 0.42, 0.66 and 0.86 of these 30 mm, with the forces of the layout file. Between two knots with zero slope, a
// cubic reaches the mean of both forces half-way, and 27/32 of the rise after three quarters of the way.
TEST_CASE("the feel along the paper's slots has the file's forces at the positions given in the README") {
  const Gate gate = paper_gate();
  const Slot& slot = slot_for(gate, 3);
  const auto force = [&](double millimetres) { return feel_force(slot.feel, millimetres * 1e-3); };
  CHECK(force(0.0) == Approx(0.0));
  CHECK(force(1.5) == Approx(-11.0 / 16.0));  // up to 3 mm: -(3 u - u^3) / 2 with u = y / 3 mm, here 1/2
  CHECK(force(3.0) == Approx(-1.0));
  CHECK(force(10.0) == Approx(-1.0));
  CHECK(force(14.2) == Approx(-4.0));
  CHECK(force(18.4) == Approx(-1.0));
  CHECK(force(22.6) == Approx(-6.0));
  CHECK(force(26.2) == Approx(3.0));
  CHECK(force(28.0) == Approx(-6.0 + 18.0 * 27.0 / 32.0));
  CHECK(force(29.8) == Approx(12.0));
  CHECK(force(32.8) == Approx(12.0 * 11.0 / 16.0));
  CHECK(force(35.8) == Approx(0.0).epsilon(1e-9));
  CHECK(force(38.8) == Approx(-12.0 * 11.0 / 16.0));
  CHECK(slot.rest == Approx(0.0358));
  CHECK(slot.engage_depth == Approx(0.0325));
  CHECK(slot.release_depth == Approx(0.0226));
  CHECK(slot.end == Approx(0.040));
}

TEST_CASE("the select force pulls to the neutral column, with full strength from its slot's wall on") {
  const Gate gate = paper_gate();
  CHECK(feel_force(gate.select_feel, -0.030) == Approx(3.0));
  CHECK(feel_force(gate.select_feel, -0.005) == Approx(3.0));
  CHECK(feel_force(gate.select_feel, 0.0) == Approx(0.0));
  CHECK(feel_force(gate.select_feel, 0.0025) == Approx(-3.0 * 11.0 / 16.0));
  CHECK(feel_force(gate.select_feel, 0.005) == Approx(-3.0));
  CHECK(feel_force(gate.select_feel, 0.035) == Approx(-3.0));
}

TEST_CASE("a lockout is lateral only if all gears of its column have the same kind of lockout") {
  GateLayout layout = small_layout();
  layout.lockouts = {guard(kReverseGear, LockoutKind::push_down)};
  CHECK_FALSE(compile_gate(layout, kPaperWorkspace).lockout[0].lateral);

  layout.columns[1].forward.gear = kNeutralGear;  // now R is the only gear in its column
  const Gate reverse_only = compile_gate(layout, kPaperWorkspace);
  CHECK(reverse_only.lockout[0].lateral);
  CHECK(reverse_only.lockout[0].barrier == Approx(0.015));
  CHECK(reverse_only.lockout[0].beyond == +1);

  layout.columns[1].forward.gear = 3;  // now both gears of the column have the same kind of lockout
  layout.lockouts.push_back(guard(3, LockoutKind::push_down));
  CHECK(compile_gate(layout, kPaperWorkspace).lockout[0].lateral);
  layout.lockouts[1].kind = LockoutKind::lift;  // now the kinds differ, so each lockout closes its own slot
  CHECK_FALSE(compile_gate(layout, kPaperWorkspace).lockout[0].lateral);
  CHECK_FALSE(compile_gate(layout, kPaperWorkspace).lockout[1].lateral);
}

TEST_CASE("a lockout is never lateral if it would block another column or the neutral column") {
  GateLayout layout = small_layout();
  layout.columns[1].forward.gear = kNeutralGear;
  layout.columns.push_back({});
  layout.columns[2].position = 0.055;
  layout.columns[2].forward.gear = 3;
  layout.lockouts = {guard(kReverseGear, LockoutKind::lift)};
  CHECK_FALSE(compile_gate(layout, kPaperWorkspace).lockout[0].lateral);

  GateLayout guarded_neutral = small_layout();
  guarded_neutral.lockouts = {guard(1, LockoutKind::lift), guard(2, LockoutKind::lift)};
  CHECK_FALSE(compile_gate(guarded_neutral, kPaperWorkspace).lockout[0].lateral);
}

TEST_CASE("a layout built in code is checked like one from a file") {
  const auto refused = [](const GateLayout& layout) {
    try {
      compile_gate(layout, kPaperWorkspace);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("not refused");
  };
  GateLayout layout = small_layout();
  CHECK(refused(layout) == "not refused");
  layout.aisle_width = 0.0039;
  CHECK(refused(layout) == "small.toml: an aisle of 3.9 mm is too narrow; it must be at least 4 mm wide");
  layout.aisle_width = std::nan("");
  CHECK(refused(layout).find("is too narrow") != std::string::npos);
  layout = small_layout();
  layout.columns[1].position = std::nan("");
  CHECK(refused(layout).find("is not to the right") != std::string::npos);
  layout = small_layout();
  layout.neutral_column = 2;
  CHECK(refused(layout) == "small.toml: the neutral column is not one of the columns");
  layout = small_layout();
  layout.lockouts.assign(kMaxLockouts + 1, guard(1, LockoutKind::lift));
  CHECK(refused(layout) == "small.toml: a gate can have at most 16 lockouts");
}

TEST_CASE("the device's reach is that of its two joints, corners included") {
  int inside = 0, outside = 0;
  for (int i = -130; i <= 130; ++i) {
    for (int j = -130; j <= 130; ++j) {
      const dvec2 point = 1e-3 * dvec2(i, j);
      CHECK(reaches(kPaperWorkspace, kPaperYokeRadius, point) == yoke_reaches(point));
      ++(yoke_reaches(point) ? inside : outside);
    }
  }
  CHECK(inside > 10000);
  CHECK(outside > 10000);
}

TEST_CASE("a flat device reaches its whole rectangle") {
  const double flat = std::numeric_limits<double>::infinity();
  CHECK(reaches({0.07, 0.06}, flat, {-0.07, 0.06}));
  CHECK_FALSE(reaches({0.07, 0.06}, flat, {0.0701, 0.0}));
  CHECK_FALSE(reaches({0.07, 0.06}, flat, {0.0, -0.0601}));
  CHECK_FALSE(reaches({0.07, 0.06}, flat, {std::nan(""), 0.0}));
}

TEST_CASE("far columns or long slots are within reach, both together are not") {
  const auto with = [](double side, double length) {
    GateLayout layout = small_layout();
    layout.columns[0].position = -side;
    layout.columns[1].position = side;
    layout.slot_length = length;
    return layout;
  };
  CHECK_NOTHROW(compile_gate(with(0.058, 0.040), kPaperWorkspace));
  CHECK_NOTHROW(compile_gate(with(0.012, 0.060), kPaperWorkspace));
  CHECK_THROWS_WITH_AS(compile_gate(with(0.058, 0.060), kPaperWorkspace),
                       "small.toml: the column at -58 mm has its wall at 63 mm, outside the workspace, which is "
                       "narrower at its corners; with end stops at 60 mm, walls must lie within 20.4 mm of "
                       "the centre",
                       FileError);
  CHECK_NOTHROW(compile_gate(with(0.058, 0.060), kPaperWorkspace, std::numeric_limits<double>::infinity()));

  // The message's limit of 20.4 mm is exact. The wall is 5 mm further out than the column's centre, so a column at
  // 15.4 mm compiles, and a column at 15.6 mm does not.
  CHECK_NOTHROW(compile_gate(with(0.0154, 0.060), kPaperWorkspace));
  CHECK_THROWS_AS(compile_gate(with(0.0156, 0.060), kPaperWorkspace), FileError);
}

TEST_CASE("a column with a gear on one side only is closed on the other") {
  GateLayout layout = small_layout();
  layout.columns[1].forward.gear = kNeutralGear;
  layout.columns[1].junction = JunctionKind::closed;
  layout.feel.buffer_force = 2.0;
  const Gate gate = compile_gate(layout, kPaperWorkspace);
  CHECK(gate.column[1].forward == Approx(gate.half_aisle));
  CHECK(gate.column[1].forward_slot == kNoSlot);
  REQUIRE(gate.buffer_count == 1);
  CHECK((gate.buffer[0].back_open && !gate.buffer[0].forward_open));
  const JunctionInfo junction = describe_gate(gate).junctions.at(1);
  CHECK((junction.left && !junction.right && !junction.forward && junction.back && junction.buffer));
}

TEST_CASE("any valid layout compiles to a gate that satisfies the laws") {
  for (std::uint64_t seed = 1; seed <= kRandomLayouts; ++seed) {
    for (const GateLayout& layout : {random_layout(seed), random_wide_layout(seed)}) {
      CAPTURE(layout.file);
      const Gate gate = compile_gate(layout, kPaperWorkspace);
      check_places(gate);
      check_lockouts(gate);
      check_description(gate);
      check_constant_at_mouths(gate);
      for (const Slot& slot : slots(gate)) check_lock(gate, slot);
      check_smooth(gate.slot[0].feel, 0.0, gate.slot[0].end);
      check_smooth(gate.select_feel, gate.select_min, gate.select_max);
      CHECK(reaches_every_gear(gate));
    }
  }
}

// The reader allows aisle widths of 4 to 40 mm, slot widths of 4 to 30 mm and chamfers of up to 10 mm. It allows lock
// forces of 1 to 25 N, detent forces of up to 20 N and mouth forces of up to 15 N.
TEST_CASE("wide random layouts cover the ranges that the reader allows") {
  double aisle = 0.0, slot = 0.0, chamfer = 0.0, lock = 0.0, detent = 0.0, mouth = 0.0, narrowest = 1.0,
         min_lock = 99.0;
  for (std::uint64_t seed = 1; seed <= kRandomLayouts; ++seed) {
    const GateLayout layout = random_wide_layout(seed);
    aisle = std::max(aisle, layout.aisle_width);
    slot = std::max(slot, layout.slot_width);
    chamfer = std::max(chamfer, layout.chamfer);
    lock = std::max(lock, layout.feel.lock_force);
    detent = std::max(detent, layout.feel.detent_force);
    mouth = std::max(mouth, layout.feel.mouth_force);
    narrowest = std::min({narrowest, layout.aisle_width, layout.slot_width});
    min_lock = std::min(min_lock, layout.feel.lock_force);
  }
  CHECK(narrowest < 0.005);
  CHECK(aisle > 0.035);
  CHECK(slot > 0.025);
  CHECK(chamfer > 0.009);
  CHECK(min_lock < 2.0);
  CHECK(lock > 23.0);
  CHECK(detent > 18.0);
  CHECK(mouth > 13.0);
}

TEST_CASE("random layouts are reproducible and differ from each other") {
  CHECK(random_layout_text(7) == random_layout_text(7));
  CHECK(random_layout_text(7) != random_layout_text(8));
  int with_lockouts = 0, with_buffers = 0, with_reverse = 0;
  for (std::uint64_t seed = 1; seed <= kRandomLayouts; ++seed) {
    const Gate gate = compile_gate(random_layout(seed), kPaperWorkspace);
    with_lockouts += gate.lockout_count > 0;
    with_buffers += gate.buffer_count > 0;
    with_reverse += slot_of_gear(gate, kReverseGear) != kNoSlot;
  }
  // The generator must produce every feature often enough to test it.
  CHECK(with_lockouts > kRandomLayouts / 4);
  CHECK(with_buffers > kRandomLayouts / 4);
  CHECK(with_reverse > kRandomLayouts / 4);
}
