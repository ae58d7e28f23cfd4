// Answers whether a wall (K, B) is stable on a device at a sampling period T, and maps the stable K and B.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "haptics/analysis/sampled_loop.h"

namespace gearshift::lab {

struct JudgedHand {
  std::string name;
  haptics::HandImpedance hand;
};

struct StabilityQuestion {
  std::string device;  // display name
  haptics::AxisModel handle;
  double rate = 1000.0;           // [Hz]
  haptics::ContactLaw wall;       // wanted
  std::vector<JudgedHand> hands;  // at least one

  double period() const { return 1.0 / rate; }  // [s]
};

struct HandVerdict {
  double limit = 0.0;   // [N/m] exact stability limit, from 0 to infinity
  double radius = 0.0;  // [1] spectral radius for the wanted wall
};

struct StabilityAnswer {
  std::vector<HandVerdict> hands;  // one per hand of the question
  std::size_t deciding = 0;        // the hand with the lowest limit
  double limit = 0.0;              // [N/m] limit of the deciding hand
  double radius = 0.0;             // [1] largest spectral radius of all hands
  bool stable = false;             // the wanted wall is stable with every hand
  // True if the wanted wall and all softer ones are stable: a contact passes through softer walls as it begins and
  // ends.
  bool may_use = false;
  // Result of the paper's passivity conditions, valid for every passive hand. Empty for the observer hold, see
  // passivity.h.
  std::optional<double> passive_limit;  // [N/m]
  std::optional<bool> passive;          // the wanted wall is passive
};

// Throws std::invalid_argument if a value is outside the range of the analysis.
StabilityAnswer answer(const StabilityQuestion& question);

// The largest stable stiffness as a function of the wall's damping (the Z-width of the literature).
struct StabilityMap {
  std::vector<double> damping;              // [N s/m] from 0 to beyond the largest value that is stable with every hand
  std::vector<std::vector<double>> limits;  // [N/m] exact limits for each hand and each damping
  std::vector<double> passive;              // [N/m] over damping
};

// progress: called with the fraction done, 0 to 1.
StabilityMap stability_map(const StabilityQuestion& question, const std::function<void(double)>& progress);

}  // namespace gearshift::lab
