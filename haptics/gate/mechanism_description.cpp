#include "haptics/gate/mechanism_description.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "haptics/gate/aisle.h"

namespace gearshift::haptics {
namespace {

using glm::dvec2;

constexpr int kArcSteps = 12;  // straight walls that draw a round end

std::string roman(std::size_t number) {
  std::string text;
  for (const auto& [value, letters] :
       {std::pair<std::size_t, const char*>{10, "X"}, {9, "IX"}, {5, "V"}, {4, "IV"}, {1, "I"}})
    for (; number >= value; number -= value) text += letters;
  return text;
}

dvec2 across(const Aisle& aisle) {
  return {-aisle.along.y, aisle.along.x};
}

dvec2 on_end(const Aisle& aisle, bool is_first, int step) {
  const double angle = std::numbers::pi * step / kArcSteps;
  const dvec2 out = is_first ? -aisle.along : aisle.along, side = is_first ? across(aisle) : -across(aisle);
  return (is_first ? aisle.from : aisle.to) + aisle.half_width * (std::cos(angle) * side + std::sin(angle) * out);
}

std::vector<dvec2> outline_of(const Aisle& aisle) {
  std::vector<dvec2> points;
  for (const bool is_first : {true, false})
    for (int step = 0; step <= kArcSteps; ++step) points.push_back(on_end(aisle, is_first, step));
  return points;
}

bool is_horizontal(const Aisle& aisle) {
  return std::abs(aisle.along.x) > std::abs(aisle.along.y);
}

// Marks the direction out of the junction that is nearest to `way`.
void open_way(JunctionInfo& junction, dvec2 way) {
  if (std::abs(way.x) > std::abs(way.y))
    (way.x > 0.0 ? junction.right : junction.left) = true;
  else
    (way.y > 0.0 ? junction.forward : junction.back) = true;
}

void add_junctions(const Gate& gate, GateDescription& list) {
  const auto all = aisles(gate);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const std::optional<dvec2> at = meeting_point(all[i], all[k]);
      if (!at) continue;
      auto junction = std::find_if(list.junctions.begin(), list.junctions.end(), [&](const JunctionInfo& other) {
        return glm::distance(other.center, *at) < kOnLine;
      });
      if (junction == list.junctions.end()) {
        list.junctions.push_back({roman(list.junctions.size() + 1), *at, false, false, false, false, false});
        junction = list.junctions.end() - 1;
      }
      for (const Aisle* aisle : {&all[i], &all[k]})
        for (const dvec2 way : ways_from(*aisle, *at)) open_way(*junction, way);
    }
  }
}

// Name of what lies at an end of a stretch of an aisle: the junction there, a place, or "end".
std::string end_name(const Gate& gate, const GateDescription& list, const Aisle& aisle, double low, double high) {
  const auto is_at = [&](dvec2 p) {
    const double s = position_along(aisle, p);
    return distance_to(aisle, p) < kOnLine && s > low - 1e-6 && s < high + 1e-6;
  };
  for (const JunctionInfo& junction : list.junctions)
    if (is_at(junction.center)) return junction.name;
  for (const Slot& place : slots(gate))
    if (is_at(place.at)) return gear_label(gate, place.gear);
  return "end";
}

// The parts of the interval of a line that lie in no other aisle. `inset`: [m] how much narrower the others are taken.
std::vector<LineInterval> outside_others(const Gate& gate, std::size_t own, dvec2 p, dvec2 direction, LineInterval all,
                                         double inset = 0.0) {
  std::vector<LineInterval> left{all};
  for (std::size_t i = 0; i < aisles(gate).size(); ++i) {
    if (i == own) continue;
    Aisle other = gate.aisle[i];
    other.half_width -= inset;
    const LineInterval cut = line_inside(whole(other), p, direction);
    if (cut.high < cut.low) continue;
    std::vector<LineInterval> next;
    for (const LineInterval part : left) {
      if (part.low < std::min(part.high, cut.low)) next.push_back({part.low, std::min(part.high, cut.low)});
      if (std::max(part.low, cut.high) < part.high) next.push_back({std::max(part.low, cut.high), part.high});
    }
    left = next;
  }
  return left;
}

void add_sides(const Gate& gate, std::size_t index, LineInterval part, WallRole role, int pair, GateDescription& list) {
  const Aisle& aisle = gate.aisle[index];
  for (const double side : {1.0, -1.0}) {
    const dvec2 start = aisle.from + side * aisle.half_width * across(aisle);
    for (const LineInterval wall : outside_others(gate, index, start, aisle.along, part))
      list.walls.push_back({start + wall.low * aisle.along, start + wall.high * aisle.along, role, pair});
  }
}

void add_aisle_walls(const Gate& gate, std::size_t index, GateDescription& list) {
  const Aisle& aisle = gate.aisle[index];
  for (const LineInterval overlap : overlaps_of(gate, index))
    add_sides(gate, index, overlap, WallRole::closed_side, -1, list);
  for (const LineInterval stretch : stretches_of(gate, index)) {
    const auto before = stretch.low > 0.0 ? end_name(gate, list, aisle, 0.0, stretch.low)
                                          : end_name(gate, list, aisle, stretch.low, stretch.low);
    const auto after = stretch.high < aisle.length ? end_name(gate, list, aisle, stretch.high, aisle.length)
                                                   : end_name(gate, list, aisle, stretch.high, stretch.high);
    list.wall_pairs.push_back({before + "-" + after, is_horizontal(aisle)});
    add_sides(gate, index, stretch, WallRole::aisle, static_cast<int>(list.wall_pairs.size()) - 1, list);
  }
  // Where two ends share a circle, as at a corner, its chords are just inside both.
  for (const bool is_first : {true, false}) {
    for (int step = 0; step < kArcSteps; ++step) {
      const dvec2 a = on_end(aisle, is_first, step), b = on_end(aisle, is_first, step + 1);
      const double length = glm::distance(a, b);
      for (const LineInterval wall :
           outside_others(gate, index, a, (b - a) / length, {0.0, length}, 0.02 * aisle.half_width))
        list.walls.push_back(
            {a + wall.low * (b - a) / length, a + wall.high * (b - a) / length, WallRole::end_stop, -1});
    }
  }
}

}  // namespace

GateDescription describe_mechanism(const Gate& gate) {
  GateDescription list;
  for (const Aisle& aisle : aisles(gate)) {
    AisleInfo info;
    info.name = std::to_string(list.aisles.size() + 1);
    info.horizontal = is_horizontal(aisle);
    info.min = glm::min(aisle.from, aisle.to) - aisle.half_width;
    info.max = glm::max(aisle.from, aisle.to) + aisle.half_width;
    info.outline = outline_of(aisle);
    list.aisles.push_back(info);
  }
  add_junctions(gate, list);
  for (std::size_t i = 0; i < aisles(gate).size(); ++i) add_aisle_walls(gate, i, list);
  return list;
}

}  // namespace gearshift::haptics
