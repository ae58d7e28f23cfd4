#include "app/lab/gate/gate_report.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace gearshift::lab {

double millimetres(double metres) {
  return std::round(metres * 1e9) / 1e6;
}

std::vector<std::string> open_directions(const haptics::JunctionInfo& junction) {
  std::vector<std::string> names;
  if (junction.left) names.emplace_back("left");
  if (junction.right) names.emplace_back("right");
  if (junction.forward) names.emplace_back("forward");
  if (junction.back) names.emplace_back("back");
  return names;
}

const char* axis_name(bool horizontal) {
  return horizontal ? "select" : "shift";
}

const std::string& junction_name(const GateReport& report, const haptics::Slot& slot) {
  return report.description.junctions.at(static_cast<std::size_t>(slot.column)).name;
}

PairSize pair_size(const haptics::GateDescription& list, std::size_t pair) {
  PairSize size;
  for (std::size_t i = 0; i < list.walls.size(); ++i) {
    if (list.walls[i].pair == static_cast<int>(pair)) size.walls.push_back(i);
  }
  const haptics::WallInfo& a = list.walls[size.walls.at(0)];
  const haptics::WallInfo& b = list.walls[size.walls.at(1)];
  const glm::dvec2 direction = (a.to - a.from) / glm::distance(a.from, a.to);
  const auto along = [&](glm::dvec2 p) { return glm::dot(p, direction); };
  const glm::dvec2 off = b.from - a.from;
  size.width = std::abs(direction.x * off.y - direction.y * off.x);
  const double from = std::max(std::min(along(a.from), along(a.to)), std::min(along(b.from), along(b.to)));
  const double to = std::min(std::max(along(a.from), along(a.to)), std::max(along(b.from), along(b.to)));
  size.length = to - from;
  return size;
}

}  // namespace gearshift::lab
