#include "app/lab/gate/gate_report.h"

#include <algorithm>
#include <cmath>

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
  const bool horizontal = list.wall_pairs.at(pair).horizontal;
  const auto along = [&](glm::dvec2 p) { return horizontal ? p.x : p.y; };
  size.width = horizontal ? std::abs(a.from.y - b.from.y) : std::abs(a.from.x - b.from.x);
  const double from = std::max(std::min(along(a.from), along(a.to)), std::min(along(b.from), along(b.to)));
  const double to = std::min(std::max(along(a.from), along(a.to)), std::max(along(b.from), along(b.to)));
  size.length = to - from;
  return size;
}

}  // namespace gearshift::lab
