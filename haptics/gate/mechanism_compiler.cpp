#include "haptics/gate/mechanism_compiler.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "haptics/files/file_error.h"
#include "haptics/files/number_text.h"
#include "haptics/gate/aisle.h"
#include "haptics/gate/gate_checks.h"
#include "haptics/gate/gate_curves.h"

namespace gearshift::haptics {
namespace {

using glm::dvec2;

constexpr double kMinLength = 0.010;       // [m] of an aisle
constexpr double kMinPlaceRadius = 0.004;  // [m]
constexpr double kEqualEnergy = 1e-9;      // [J]
constexpr double kSharpest = 0.8661;       // [1] cosine of 30 degrees

[[noreturn]] void reject(const GateLayout& layout, int line, const std::string& reason) {
  throw FileError(layout.file, line, reason);
}

double distance_between(const Aisle& a, const Aisle& b) noexcept {
  return std::min({distance_to(a, b.from), distance_to(a, b.to), distance_to(b, a.from), distance_to(b, a.to)});
}

std::string point_text(dvec2 p) {
  return "(" + number_text(1e3 * p.x, 3) + ", " + number_text(1e3 * p.y, 3) + ") mm";
}

// Aisles

void add_aisles(const GateLayout& layout, Gate& gate) {
  if (layout.aisles.size() > kMaxAisles)
    reject(layout, layout.aisles[kMaxAisles].line, "a gate can have at most " + std::to_string(kMaxAisles) + " aisles");
  for (const AisleLayout& from : layout.aisles) {
    Aisle& aisle = gate.aisle[static_cast<std::size_t>(gate.aisle_count++)];
    aisle.from = {from.from_x, from.from_y};
    aisle.to = {from.to_x, from.to_y};
    aisle.length = glm::distance(aisle.from, aisle.to);
    aisle.half_width = from.width / 2.0;
    if (!(from.width >= kMinAisleWidth))
      reject(layout, from.line, "an aisle must be at least " + millimetres_text(kMinAisleWidth) + " wide");
    if (!(aisle.length >= kMinLength))
      reject(layout, from.line, "an aisle must be at least " + millimetres_text(kMinLength) + " long");
    aisle.along = (aisle.to - aisle.from) / aisle.length;
  }
}

// Two aisles either meet, so that each leads into the other over its full width, or a wall separates them.
void check_pair(const GateLayout& layout, const Gate& gate, std::size_t index, std::size_t before) {
  const Aisle &a = gate.aisle[index], &b = gate.aisle[before];
  const int line = layout.aisles[index].line;
  const std::string other = "the aisle on line " + std::to_string(layout.aisles[before].line);
  if (const std::optional<dvec2> at = meeting_point(a, b)) {
    for (const dvec2 way : ways_from(a, *at))
      for (const dvec2 there : ways_from(b, *at))
        if (glm::dot(way, there) > kSharpest)
          reject(layout, line, "this aisle and " + other + " must meet at an angle of at least 30 degrees");
    return;
  }
  const double apart = distance_between(a, b), wall = apart - a.half_width - b.half_width;
  if (wall < kMinWall)
    reject(layout, line,
           "this aisle and " + other + " are " + millimetres_text(apart) +
               " apart; let their centre lines meet, or leave a wall of " + millimetres_text(kMinWall) +
               " between them: " + millimetres_text(apart - wall + kMinWall));
}

void check_connected(const GateLayout& layout, const Gate& gate) {
  std::vector<bool> reached(static_cast<std::size_t>(gate.aisle_count), false);
  std::vector<std::size_t> open{0};
  reached[0] = true;
  while (!open.empty()) {
    const std::size_t here = open.back();
    open.pop_back();
    for (std::size_t next = 0; next < reached.size(); ++next) {
      if (reached[next] || !meeting_point(gate.aisle[here], gate.aisle[next])) continue;
      reached[next] = true;
      open.push_back(next);
    }
  }
  const auto lost = std::find(reached.begin(), reached.end(), false);
  if (lost != reached.end())
    reject(layout, layout.aisles[static_cast<std::size_t>(lost - reached.begin())].line,
           "no way leads from the first aisle to this one; let the centre lines of aisles meet");
}

void check_reach(const GateLayout& layout, const Gate& gate, dvec2 workspace, double radius) {
  for (std::size_t i = 0; i < layout.aisles.size(); ++i) {
    const Aisle& aisle = gate.aisle[i];
    for (const dvec2 end : {aisle.from, aisle.to}) {
      const dvec2 wall = glm::dvec2(std::abs(end.x), std::abs(end.y)) + aisle.half_width;
      // The corner of both walls is outside the round end, but near enough to be the same limit as in an H gate.
      if (reaches(workspace, radius, wall + kWorkspaceMargin)) continue;
      reject(layout, layout.aisles[i].line,
             "the end at " + point_text(end) + " is outside the workspace: the device reaches " +
                 millimetres_text(workspace.x) + " sideways and " + millimetres_text(workspace.y) +
                 " fore and aft, less in its corners, and walls must stay " + millimetres_text(kWorkspaceMargin) +
                 " inside");
    }
  }
}

// Places

std::string place_text(const PlaceLayout& place) {
  const std::string name = place.label.empty() ? std::string(gear_name(place.gear)) : place.label;
  return "place \"" + name + "\"";
}

std::uint32_t aisles_at(const Gate& gate, dvec2 p) {
  std::uint32_t set = 0;
  for (int i = 0; i < gate.aisle_count; ++i)
    if (distance_to(gate.aisle[static_cast<std::size_t>(i)], p) < kOnLine) set |= 1u << i;
  return set;
}

// The largest radius that leaves out other places of the same aisle, and aisles that do not lead through this place.
double room_for(const GateLayout& layout, const Gate& gate, std::size_t index, std::uint32_t own_aisles) {
  const dvec2 at{layout.places[index].x, layout.places[index].y};
  double room = HUGE_VAL;
  for (std::size_t i = 0; i < layout.places.size(); ++i) {
    const dvec2 there{layout.places[i].x, layout.places[i].y};
    if (i == index || (aisles_at(gate, there) & own_aisles) == 0) continue;
    const double distance = glm::distance(at, there);
    room = std::min(room, distance - (layout.places[i].radius > 0.0 ? layout.places[i].radius : distance / 2.0));
  }
  for (int i = 0; i < gate.aisle_count; ++i) {
    const Aisle& aisle = gate.aisle[static_cast<std::size_t>(i)];
    if ((own_aisles >> i & 1u) == 0) room = std::min(room, distance_to(aisle, at) - aisle.half_width);
  }
  return room;
}

double place_radius(const GateLayout& layout, const Gate& gate, std::size_t index, std::uint32_t own_aisles) {
  const PlaceLayout& place = layout.places[index];
  const double room = room_for(layout, gate, index, own_aisles);
  const double needed = std::max(kMinPlaceRadius, place.radius);
  if (room < needed - 1e-9)
    reject(layout, place.line,
           place_text(place) + " needs a radius of " + millimetres_text(needed) +
               ", but other places and aisles leave " + millimetres_text(std::max(0.0, room)));
  return place.radius > 0.0 ? place.radius : std::min(room, kPlaceRadius);
}

void add_place(const GateLayout& layout, std::size_t index, Gate& gate) {
  const PlaceLayout& from = layout.places[index];
  Slot& slot = gate.slot[static_cast<std::size_t>(gate.slot_count++)];
  slot.at = {from.x, from.y};
  slot.gear = from.gear;
  from.label.copy(slot.label.data(), kMaxLabel);
  slot.aisles = aisles_at(gate, slot.at);
  if (slot.aisles == 0)
    reject(layout, from.line, place_text(from) + " at " + point_text(slot.at) + " is on the centre line of no aisle");
  const double radius = place_radius(layout, gate, index, slot.aisles);
  slot.end = slot.rest = radius;
  slot.engage_depth = kPlaceEngage * radius;
  slot.release_depth = kPlaceRelease * radius;
  if (from.lock_force > 0.0) slot.feel = make_feel_curve(place_knots(radius, from.lock_force, from.detent_force));
  if (steepest(slot.feel) > kMaxFeelSlope)
    reject(layout, from.line,
           place_text(from) + " has a radius of " + millimetres_text(radius) + ", in which its forces would rise by " +
               number_text(steepest(slot.feel), 4) + " N/m and feel like a wall; allowed are " +
               number_text(kMaxFeelSlope) + " N/m");
}

void add_places(const GateLayout& layout, Gate& gate) {
  if (layout.places.size() > kMaxSlots)
    reject(layout, layout.places[kMaxSlots].line, "a gate can have at most " + std::to_string(kMaxSlots) + " places");
  std::set<int> gears;
  std::set<std::string> labels;
  for (std::size_t i = 0; i < layout.places.size(); ++i) {
    const PlaceLayout& place = layout.places[i];
    const bool again = !gears.insert(place.gear).second;
    if (again && place.gear == kNeutralGear) reject(layout, place.line, "only one place can be neutral");
    if (again || (!place.label.empty() && !labels.insert(place.label).second))
      reject(layout, place.line, place_text(place) + " is already in the file");
    add_place(layout, i, gate);
  }
  if (gears.count(kNeutralGear) == 0)
    reject(layout, layout.aisles.front().line, "no place is neutral; write neutral = true in exactly one [[place]]");
  if (layout.places.size() < 2)
    reject(layout, layout.places.front().line, "a gate needs a place beside the neutral one");
}

// Springs

// Adds knots of a constant force from `low` to `high`, with a ramp at the ends where it is zero.
void add_flank(double low, bool rises, double high, bool falls, double force, std::vector<FeelKnot>& knots) {
  constexpr double kRamp = 0.006;  // [m]
  if (high - low < 1e-6) return;
  const double ramp = std::min(kRamp, (high - low) / 2.0);
  if (rises) knots.push_back({low, 0.0, 0.0});
  knots.push_back({rises ? low + ramp : low, force, 0.0});
  knots.push_back({falls ? high - ramp : high, force, 0.0});
  if (falls) knots.push_back({high, 0.0, 0.0});
}

// The force towards `to` on one stretch. It is zero at `to` and next to other aisles, but not at a dead end.
void add_stretch(LineInterval stretch, double to, double force, double length, std::vector<FeelKnot>& knots) {
  const bool rises = stretch.low > 0.0, falls = stretch.high < length;
  if (to <= stretch.low) return add_flank(stretch.low, true, stretch.high, falls, -force, knots);
  if (to >= stretch.high) return add_flank(stretch.low, rises, stretch.high, true, force, knots);
  add_flank(stretch.low, rises, to, true, force, knots);
  add_flank(to, true, stretch.high, falls, -force, knots);
}

void add_spring(const GateLayout& layout, std::size_t index, Gate& gate) {
  const AisleLayout& from = layout.aisles[index];
  Aisle& aisle = gate.aisle[index];
  if (from.spring_force == 0.0) return;
  if (from.spring_to > aisle.length + kOnLine)
    reject(layout, from.line, "spring_to_mm is beyond the end of this aisle of " + millimetres_text(aisle.length));
  std::vector<FeelKnot> all, knots;
  for (const LineInterval& stretch : stretches_of(gate, index))
    add_stretch(stretch, from.spring_to, from.spring_force, aisle.length, all);
  for (const FeelKnot& knot : all)  // neighbouring pieces share a knot
    if (knots.empty() || knot.at > knots.back().at + 1e-9) knots.push_back(knot);
  if (knots.empty())
    reject(layout, from.line,
           "spring_n would have no effect, because other aisles meet this one along its whole length");
  if (knots.size() > kMaxFeelKnots) reject(layout, from.line, "too many aisles meet this one for it to have a spring");
  aisle.spring = make_feel_curve(knots);
  if (steepest(aisle.spring) > kMaxFeelSlope)
    reject(layout, from.line, "spring_n is too large for such a short stretch; the force would feel like a wall");
}

// [J] potential of the aisle's spring at this position along it
double spring_energy(const Aisle& aisle, double to) {
  double energy = 0.0;
  for (int i = 0; i < aisle.spring.pieces; ++i) {
    const FeelCurve::Piece& piece = aisle.spring.piece[static_cast<std::size_t>(i)];
    const bool is_last = i + 1 == aisle.spring.pieces;
    const double end = is_last ? to : std::min(to, aisle.spring.piece[static_cast<std::size_t>(i) + 1].from);
    const double u = end - piece.from;
    if (u <= 0.0) break;
    energy -= u * (piece.c[0] + u * (piece.c[1] / 2.0 + u * (piece.c[2] / 3.0 + u * piece.c[3] / 4.0)));
  }
  return energy;
}

// The springs must do no work on any way round a loop of aisles.
void check_energy(const GateLayout& layout, const Gate& gate) {
  const std::size_t count = layout.aisles.size();
  std::vector<std::optional<double>> offset(count);  // [J] potential at position 0 of each aisle
  std::vector<std::size_t> open{0};
  offset[0] = 0.0;
  while (!open.empty()) {
    const std::size_t here = open.back();
    open.pop_back();
    for (std::size_t next = 0; next < count; ++next) {
      const Aisle &a = gate.aisle[here], &b = gate.aisle[next];
      const std::optional<dvec2> at = next == here ? std::nullopt : meeting_point(a, b);
      if (!at) continue;
      const double there =
          *offset[here] + spring_energy(a, position_along(a, *at)) - spring_energy(b, position_along(b, *at));
      if (!offset[next]) {
        offset[next] = there;
        open.push_back(next);
      } else if (std::abs(*offset[next] - there) > kEqualEnergy) {
        reject(
            layout, layout.aisles[next].line,
            "the springs would drive the lever round a loop of aisles for ever; make their work round it equal to 0");
      }
    }
  }
}

void add_return(const GateLayout& layout, Gate& gate) {
  const double force = layout.feel.center_force;
  if (force == 0.0) return;
  const double distance = glm::length(rest_position(gate, kNeutralGear));
  if (force < required_return_force(distance))
    reject(layout, layout.lines.feel,
           "center_force_n = " + number_text(force) + ": must be at least " +
               number_text(std::ceil(10.0 * required_return_force(distance)) / 10.0) +
               ", or the lever would not return to the neutral place; or 0, if nothing returns it");
  gate.return_feel = make_feel_curve(centring_knots(force, 0.006));
}

// Lockouts

// Each aisle of the place must be long enough for the lever to stop before the lockout.
void check_lockout_room(const GateLayout& layout, const Gate& gate, const LockoutLayout& from, const Slot& place) {
  for (int i = 0; i < gate.aisle_count; ++i) {
    const Aisle& aisle = gate.aisle[static_cast<std::size_t>(i)];
    if ((place.aisles >> i & 1u) == 0) continue;
    const double gap = kClosedRadius * place.end + aisle.half_width, at = position_along(aisle, place.at);
    for (const double side : {at, aisle.length - at}) {
      if (side > kOnLine && side < gap)
        reject(layout, from.line,
               "the aisle on line " + std::to_string(layout.aisles[static_cast<std::size_t>(i)].line) +
                   " leaves no room for a lockout; it must lead " + millimetres_text(gap) + " away from the place");
    }
  }
}

// Between two lockouts on one aisle, a lever must have room.
void check_lockouts_apart(const GateLayout& layout, const Gate& gate, const LockoutLayout& from) {
  const Slot& place = slot_of(gate, gate.lockout[static_cast<std::size_t>(gate.lockout_count - 1)].slot);
  for (const Lockout& other : lockouts(gate)) {
    const Slot& there = slot_of(gate, other.slot);
    if (&there == &place) continue;
    for (int i = 0; i < gate.aisle_count; ++i) {
      const Aisle& aisle = gate.aisle[static_cast<std::size_t>(i)];
      if (((place.aisles & there.aisles) >> i & 1u) == 0) continue;
      const double room = std::abs(position_along(aisle, place.at) - position_along(aisle, there.at));
      if (room < kClosedRadius * (place.end + there.end) + 2.0 * aisle.half_width)
        reject(layout, from.line, "two lockouts leave the lever no room between their places");
    }
  }
}

void add_lockouts(const GateLayout& layout, Gate& gate) {
  if (layout.lockouts.size() > kMaxLockouts)
    reject(layout, layout.lockouts[kMaxLockouts].line,
           "a gate can have at most " + std::to_string(kMaxLockouts) + " lockouts");
  for (const LockoutLayout& from : layout.lockouts) {
    Lockout& lockout = gate.lockout[static_cast<std::size_t>(gate.lockout_count++)];
    lockout.kind = from.kind;
    lockout.slot = slot_of_gear(gate, from.gear);
    lockout.is_leaving = from.is_leaving;
    lockout.close_above = from.close_above;
    lockout.open_below = from.open_below;
    if (from.kind == LockoutKind::speed && !(from.open_below < from.close_above))
      reject(layout, from.line,
             "open_below_kmh must be smaller than close_above_kmh, or the lockout would open and close rapidly");
    check_lockout_room(layout, gate, from, slot_of(gate, lockout.slot));
    check_lockouts_apart(layout, gate, from);
  }
}

}  // namespace

Gate compile_mechanism(const GateLayout& layout, dvec2 workspace, double radius) {
  Gate gate;
  add_aisles(layout, gate);
  for (std::size_t i = 1; i < layout.aisles.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) check_pair(layout, gate, i, k);
  check_connected(layout, gate);
  check_reach(layout, gate, workspace, radius);
  add_places(layout, gate);
  for (std::size_t i = 0; i < layout.aisles.size(); ++i) add_spring(layout, i, gate);
  check_energy(layout, gate);
  add_return(layout, gate);
  add_lockouts(layout, gate);
  return gate;
}

}  // namespace gearshift::haptics
