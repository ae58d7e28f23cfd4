#include "app/runtime/thin_out.h"

#include <algorithm>
#include <cstdint>

#include <glm/geometric.hpp>

namespace gearshift::runtime {
namespace {

bool is_weaker(const haptics::HapticSnapshot& a, const haptics::HapticSnapshot& b) {
  return glm::dot(a.f_h, a.f_h) < glm::dot(b.f_h, b.f_h);
}

}  // namespace

std::vector<haptics::HapticSnapshot> thin_out(const std::vector<haptics::HapticSnapshot>& all, std::size_t max_count) {
  if (all.size() <= max_count) return all;
  if (max_count == 0) return {};
  if (max_count == 1) return {*std::max_element(all.begin(), all.end(), is_weaker)};
  const std::size_t parts = max_count / 2;
  std::vector<haptics::HapticSnapshot> few;
  few.reserve(2 * parts);
  for (std::size_t part = 0; part < parts; ++part) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(part * all.size() / parts);
    const auto end = all.begin() + static_cast<std::ptrdiff_t>((part + 1) * all.size() / parts);
    const auto [weakest, strongest] = std::minmax_element(begin, end, is_weaker);
    few.push_back(*std::min(weakest, strongest));
    if (weakest != strongest) few.push_back(*std::max(weakest, strongest));
  }
  return few;
}

}  // namespace gearshift::runtime
