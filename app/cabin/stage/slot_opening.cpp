#include "app/cabin/stage/slot_opening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/gate/aisle.h"
#include "haptics/gate/gate_description.h"

namespace gearshift::cabin {
namespace {

constexpr double kMaxRodRadius = 0.0030;  // [m] maximum radius of the rod
constexpr double kRodFraction = 0.39;     // [1] rod radius as a fraction of the distance between two slots
constexpr double kWallStep = 0.001;    // [m] maximum length of the straight pieces that approximate a wall, at the knob
constexpr double kMaxCell = 0.0002;    // [m] maximum cell size of the distance grid
constexpr double kSlotBevel = 0.0004;  // [m] maximum bevel of the opening's edge
constexpr double kLoopTolerance = 0.00001;  // [m] tolerance for simplifying the outline

struct Segment {
  glm::dvec2 from{0.0}, to{0.0};
};

std::vector<Segment> projected_walls(const haptics::Gate& gate, const haptics::YokeGeometry& yoke, double height) {
  std::vector<Segment> walls;
  for (const haptics::WallInfo& wall : haptics::describe_gate(gate).walls) {
    const int count = std::max(1, static_cast<int>(std::ceil(glm::distance(wall.from, wall.to) / kWallStep)));
    for (int i = 0; i < count; ++i) {
      const auto at = [&](int k) {
        return plate_point(yoke, glm::mix(wall.from, wall.to, static_cast<double>(k) / count), height);
      };
      walls.push_back({at(i), at(i + 1)});
    }
  }
  return walls;
}

// Where the lever leans most, the rod's cross-section in the gate plate's plane is an ellipse. Returns its length divided
// by the rod's diameter: rho / p_z, where rho is the yoke's radius and p_z the knob's height.
double longest_section(const haptics::Gate& gate, const haptics::YokeGeometry& yoke) {
  double longest = 1.0;
  for (const haptics::WallInfo& wall : haptics::describe_gate(gate).walls) {
    const double across = std::max(glm::dot(wall.from, wall.from), glm::dot(wall.to, wall.to));
    longest = std::max(longest, yoke.radius / std::sqrt(yoke.radius * yoke.radius - across));
  }
  return longest;
}

// Smallest distance [m] between two aisles that do not meet.
double thinnest_wall_of_aisles(const haptics::Gate& gate) {
  double thinnest = std::numeric_limits<double>::infinity();
  const auto all = haptics::aisles(gate);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (haptics::meeting_point(all[i], all[k])) continue;
      const double apart =
          std::min({haptics::distance_to(all[i], all[k].from), haptics::distance_to(all[i], all[k].to),
                    haptics::distance_to(all[k], all[i].from), haptics::distance_to(all[k], all[i].to)});
      thinnest = std::min(thinnest, apart - all[i].half_width - all[k].half_width);
    }
  }
  return thinnest;
}

// Smallest distance [m] between two neighbouring slots, measured at the knob.
double thinnest_wall(const haptics::Gate& gate) {
  if (haptics::is_mechanism(gate)) return thinnest_wall_of_aisles(gate);
  double thinnest = std::numeric_limits<double>::infinity();
  for (int i = 0; i + 1 < gate.column_count; ++i) {
    const haptics::Column& a = haptics::column_of(gate, i);
    const haptics::Column& b = haptics::column_of(gate, i + 1);
    const bool side_by_side = (a.forward_slot != haptics::kNoSlot && b.forward_slot != haptics::kNoSlot) ||
                              (a.back_slot != haptics::kNoSlot && b.back_slot != haptics::kNoSlot);
    if (side_by_side) thinnest = std::min(thinnest, b.center - b.half_width - a.center - a.half_width);
  }
  return thinnest;
}

// Signed distance from the opening's edge, stored at the nodes of a square grid; negative inside the opening.
class Field {
 public:
  Field(glm::dvec2 low, glm::dvec2 high, double cell)
      : low_(low), cell_(cell), width_(count(high.x - low.x)), height_(count(high.y - low.y)) {
    value_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                  std::numeric_limits<double>::infinity());
  }

  int width() const { return width_; }
  int height() const { return height_; }
  glm::dvec2 at(int i, int j) const { return low_ + cell_ * glm::dvec2(i, j); }
  double& value(int i, int j) {
    return value_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)];
  }

  // Updates the distance to the nearest wall at all nodes within `reach` of the segment.
  void near(const Segment& segment, double reach) {
    const glm::dvec2 from = (glm::min(segment.from, segment.to) - reach - low_) / cell_;
    const glm::dvec2 to = (glm::max(segment.from, segment.to) + reach - low_) / cell_;
    const glm::dvec2 along = segment.to - segment.from;
    const double length_2 = glm::dot(along, along);
    for (int j = std::max(0, static_cast<int>(from.y)); j <= std::min(height_ - 1, static_cast<int>(to.y) + 1); ++j) {
      for (int i = std::max(0, static_cast<int>(from.x)); i <= std::min(width_ - 1, static_cast<int>(to.x) + 1); ++i) {
        const glm::dvec2 off = at(i, j) - segment.from;
        const double t = length_2 > 0.0 ? std::clamp(glm::dot(off, along) / length_2, 0.0, 1.0) : 0.0;
        value(i, j) = std::min(value(i, j), glm::length(off - t * along));
      }
    }
  }

 private:
  int count(double length) const { return static_cast<int>(std::ceil(length / cell_)) + 1; }

  glm::dvec2 low_;
  double cell_;
  int width_, height_;
  std::vector<double> value_;
};

// Finds the contour at value 0 by marching squares. Each crossing has the number of the grid edge on which it lies.
// Lines are stored as a map from each crossing to the next one, with the opening on their left.
class Contour {
 public:
  explicit Contour(Field& field) : field_(field) {
    for (int j = 0; j + 1 < field_.height(); ++j) {
      for (int i = 0; i + 1 < field_.width(); ++i) cell(i, j);
    }
  }

  // The closed line that encloses the largest area.
  Loop largest() {
    Loop best;
    while (!next_.empty()) {
      Loop loop = take_loop(next_.begin()->first);
      if (std::abs(signed_area(loop)) > std::abs(signed_area(best))) best = std::move(loop);
    }
    return best;
  }

 private:
  // Adds the contour lines in a cell. Walks around the cell's corners: each run of consecutive corners inside the
  // opening gives a line, which starts where the walk leaves the run and ends where the walk entered it.
  void cell(int i, int j) {
    const int corner_i[5] = {i, i + 1, i + 1, i, i};
    const int corner_j[5] = {j, j, j + 1, j + 1, j};
    bool cut[5];
    for (int k = 0; k < 5; ++k) cut[k] = field_.value(corner_i[k], corner_j[k]) < 0.0;
    int entry = -1;
    for (int k = 3; k >= 0; --k) {
      if (entry < 0 && !cut[k] && cut[k + 1]) entry = k;
    }
    if (entry < 0) return;
    int came_in = entry;
    for (int step = 0; step < 4; ++step) {
      const int k = (entry + step) % 4;
      if (!cut[k] && cut[k + 1]) came_in = k;
      if (cut[k] && !cut[k + 1]) {
        next_[crossing(corner_i[k], corner_j[k], corner_i[k + 1], corner_j[k + 1])] =
            crossing(corner_i[came_in], corner_j[came_in], corner_i[came_in + 1], corner_j[came_in + 1]);
      }
    }
  }

  int crossing(int i0, int j0, int i1, int j1) {
    const bool upright = i0 == i1;
    const int number = 2 * (std::min(j0, j1) * field_.width() + std::min(i0, i1)) + (upright ? 1 : 0);
    const double a = field_.value(i0, j0), b = field_.value(i1, j1);
    point_[number] = glm::mix(field_.at(i0, j0), field_.at(i1, j1), a / (a - b));
    return number;
  }

  Loop take_loop(int start) {
    Loop loop;
    for (auto at = next_.find(start); at != next_.end(); at = next_.find(start)) {
      loop.push_back(point_[at->first]);
      start = at->second;
      next_.erase(at);
    }
    return loop;
  }

  Field& field_;
  std::unordered_map<int, int> next_;
  std::unordered_map<int, glm::dvec2> point_;
};

// Moves a counter-clockwise loop inward by `by`, each point along the mean of the normals of its two edges. No edge
// reverses as long as every corner radius exceeds `by`. Here this is so, because the loop is an offset curve whose
// offset is larger than `by`.
Loop inset(const Loop& loop, double by) {
  const std::size_t n = loop.size();
  Loop moved(n);
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 in = glm::normalize(loop[i] - loop[(i + n - 1) % n]);
    const glm::dvec2 out = glm::normalize(loop[(i + 1) % n] - loop[i]);
    const glm::dvec2 left{-in.y - out.y, in.x + out.x};
    moved[i] = loop[i] + 2.0 * by / glm::dot(left, left) * left;  // mitred corner at the distance `by` from both edges
  }
  return moved;
}

}  // namespace

glm::dvec2 plate_point(const haptics::YokeGeometry& yoke, glm::dvec2 gate_point, double height) noexcept {
  return height / std::sqrt(yoke.radius * yoke.radius - glm::dot(gate_point, gate_point)) * gate_point;
}

glm::dvec2 gate_point(const haptics::YokeGeometry& yoke, glm::dvec2 plate_point, double height) noexcept {
  return yoke.radius / std::sqrt(height * height + glm::dot(plate_point, plate_point)) * plate_point;
}

SlotOpening slot_opening(const haptics::Gate& gate, const haptics::YokeGeometry& yoke, double height) {
  SlotOpening opening;
  const double lean = longest_section(gate, yoke);
  // On the plate, the distance between two slots is at least height / yoke.radius times their distance at the knob.
  const double metal = thinnest_wall(gate) * height / yoke.radius;
  opening.rod_radius = std::min(kMaxRodRadius, kRodFraction * metal / lean);
  opening.widened = lean * opening.rod_radius;
  const double rib = metal - 2.0 * opening.widened;  // [m] width of the metal left between two slots
  opening.bevel = std::min(kSlotBevel, 0.15 * rib);

  const std::vector<Segment> walls = projected_walls(gate, yoke, height);
  const double cell = std::min({kMaxCell, 0.3 * rib, 0.4 * opening.widened});
  const double level = opening.widened + opening.bevel;
  const double reach = level + 3.0 * cell;
  glm::dvec2 low{0.0}, high{0.0};
  for (const Segment& wall : walls) {
    low = glm::min(low, wall.from - reach);
    high = glm::max(high, wall.from + reach);
  }
  Field field(low, high, cell);
  for (const Segment& wall : walls) field.near(wall, reach);
  for (int j = 0; j < field.height(); ++j) {
    for (int i = 0; i < field.width(); ++i) {
      double& value = field.value(i, j);
      if (haptics::in_free_space(gate, gate_point(yoke, field.at(i, j), height))) value = 0.0;
      value = std::min(value, reach) - level;
    }
  }
  opening.face = simplified(Contour(field).largest(), kLoopTolerance);
  opening.loop = inset(opening.face, opening.bevel);
  return opening;
}

}  // namespace gearshift::cabin
