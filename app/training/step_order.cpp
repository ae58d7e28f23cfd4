// This work is based on:
// Robert A. Wagner, Michael J. Fischer. The String-to-String Correction Problem. 1974
#include "app/training/step_order.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace gearshift {
namespace {

int edit_distance(std::span<const ShiftStep> a, std::span<const ShiftStep> b) {
  std::vector<int> row(b.size() + 1);  // distances of the first i of a to the first j of b
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<ShiftStep> taught_steps(int from, int to) {
  std::vector<ShiftStep> steps{ShiftStep::throttle_off, ShiftStep::clutch_down};
  if (from != kNeutralGear) steps.push_back(ShiftStep::neutral);
  if (to != kNeutralGear) steps.push_back(ShiftStep::gear);
  steps.insert(steps.end(), {ShiftStep::clutch_up, ShiftStep::throttle_on});
  return steps;
}

int steps_out_of_place(std::span<const ShiftStep> steps, int from, int to) {
  const std::vector<ShiftStep> taught = taught_steps(from, to);
  const std::span<const ShiftStep> whole(taught);
  return std::min(edit_distance(steps, whole), edit_distance(steps, whole.first(whole.size() - 1)));
}

}  // namespace gearshift
