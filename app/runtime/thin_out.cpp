#include "app/runtime/thin_out.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace gearshift::runtime {
namespace {

bool is_weaker(const vehicle::DriveSample& a, const vehicle::DriveSample& b) {
  return glm::dot(a.lever.f_h, a.lever.f_h) < glm::dot(b.lever.f_h, b.lever.f_h);
}

}  // namespace

void thin_out(std::span<const vehicle::DriveSample> cycles, std::size_t max_count,
              std::vector<haptics::HapticSnapshot>& few) {
  few.clear();
  if (cycles.size() <= max_count) {
    for (const vehicle::DriveSample& cycle : cycles) few.push_back(cycle.lever);
    return;
  }
  if (max_count == 0) return;
  if (max_count == 1) return few.push_back(std::max_element(cycles.begin(), cycles.end(), is_weaker)->lever);
  const std::size_t parts = max_count / 2;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * cycles.size() / parts, end = (part + 1) * cycles.size() / parts;
    const auto of_part = cycles.subspan(begin, end - begin);
    const auto [weakest, strongest] = std::minmax_element(of_part.begin(), of_part.end(), is_weaker);
    few.push_back(std::min(weakest, strongest)->lever);
    if (weakest != strongest) few.push_back(std::max(weakest, strongest)->lever);
  }
}

}  // namespace gearshift::runtime
