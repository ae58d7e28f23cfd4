// This work is based on:
// Robert A. Wagner, Michael J. Fischer. The String-to-String Correction Problem. 1974
#include "app/lessons/assessment/step_order.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

namespace gearshift::lessons {
namespace {

using Steps = std::vector<ShiftStep>;

// Returns, for each j, the edit distance between all of `a` and the first j steps of `b`.
std::vector<int> edit_distances(std::span<const ShiftStep> a, std::span<const ShiftStep> b) {
  std::vector<int> row(b.size() + 1);  // row[j]: distance between the first i steps of a and the first j steps of b
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row;
}

// Double declutching: clutch up and down again in neutral.
Steps double_declutched() {
  using enum ShiftStep;
  return {throttle_off, clutch_down, neutral, clutch_up, clutch_down, gear, clutch_up, throttle_on};
}

// Returns all variants of `order` with a blip (a short press of the throttle) that starts between the first clutch down
// and the last clutch up. The throttle is released before or right after the last clutch up, or stays pressed and
// replaces the final throttle step.
std::vector<Steps> with_blip(const Steps& order) {
  const auto first = std::find(order.begin(), order.end(), ShiftStep::clutch_down) - order.begin() + 1;
  const auto last = order.rend() - std::find(order.rbegin(), order.rend(), ShiftStep::clutch_up) - 1;
  std::vector<Steps> orders;
  for (auto on = first; on <= last; ++on) {
    for (auto off = on; off <= last + 1; ++off) {
      Steps blip = order;
      blip.insert(blip.begin() + off, ShiftStep::throttle_off);
      blip.insert(blip.begin() + on, ShiftStep::throttle_on);
      orders.push_back(blip);
    }
    Steps held = order;
    held.insert(held.begin() + on, ShiftStep::throttle_on);
    orders.push_back(held);
  }
  return orders;
}

std::vector<Steps> taught_orders(int from, int to) {
  std::vector<Steps> orders{taught_steps(from, to)};
  if (from == haptics::kNeutralGear || to == haptics::kNeutralGear) return orders;
  orders.push_back(double_declutched());
  if (to < 1 || to >= from) return orders;
  for (const Steps& order : {orders[0], orders[1]}) {
    const std::vector<Steps> blips = with_blip(order);
    orders.insert(orders.end(), blips.begin(), blips.end());
  }
  return orders;
}

}  // namespace

std::vector<ShiftStep> taught_steps(int from, int to) {
  std::vector<ShiftStep> steps{ShiftStep::throttle_off, ShiftStep::clutch_down};
  if (from != haptics::kNeutralGear) steps.push_back(ShiftStep::neutral);
  if (to != haptics::kNeutralGear) steps.push_back(ShiftStep::gear);
  steps.insert(steps.end(), {ShiftStep::clutch_up, ShiftStep::throttle_on});
  return steps;
}

int steps_out_of_place(std::span<const ShiftStep> steps, int from, int to, bool is_complete) {
  int min_distance = std::numeric_limits<int>::max();
  for (const Steps& order : taught_orders(from, to)) {
    const std::vector<int> distances = edit_distances(steps, order);
    min_distance = std::min(min_distance,
                            *std::min_element(is_complete ? distances.end() - 2 : distances.begin(), distances.end()));
  }
  return min_distance;
}

OrderMistake first_order_mistake(std::span<const ShiftStep> steps, int from, int to) {
  using enum ShiftStep;
  const auto first = [&](ShiftStep step) { return std::find(steps.begin(), steps.end(), step) - steps.begin(); };
  const auto has = [&](ShiftStep step) { return std::find(steps.begin(), steps.end(), step) != steps.end(); };
  const auto last = [&](ShiftStep step) { return steps.rend() - std::find(steps.rbegin(), steps.rend(), step); };
  const bool down = to >= 1 && to < from;
  if (!has(throttle_off)) return OrderMistake::throttle_stayed;
  if (first(throttle_off) > first(clutch_down)) return OrderMistake::throttle_late;
  if (has(neutral) && first(neutral) < first(clutch_down)) return OrderMistake::lever_first;
  if (has(gear) && has(clutch_up) && last(clutch_up) < last(gear)) return OrderMistake::clutch_before_gear;
  if (!down && has(throttle_on) && has(clutch_up) && first(throttle_on) < last(clutch_up) - 1)
    return OrderMistake::throttle_early;
  return OrderMistake::other;
}

}  // namespace gearshift::lessons
