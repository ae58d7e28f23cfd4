// Computes whether a wall with stiffness K and damping B is stable on a device at a given sampling period, and maps the
// stable values of K and B.
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
  double encoder_step = 0.0;      // [m] motion of the tip per encoder count, for the trainer's laws; 0: none

  double period() const { return 1.0 / rate; }  // [s]
};

struct HandVerdict {
  double limit = 0.0;   // [N/m] exact stability limit, from 0 to infinity
  double radius = 0.0;  // [1] spectral radius with the wanted wall
};

struct StabilityAnswer {
  std::vector<HandVerdict> hands;  // one verdict per hand of the question
  std::size_t deciding = 0;        // index of the deciding hand, which has the lowest limit
  double limit = 0.0;              // [N/m] limit of the deciding hand
  double radius = 0.0;             // [1] largest spectral radius of all hands
  bool stable = false;             // the wanted wall is stable with every hand
  // True if the wanted wall and all softer walls are stable. Softer walls count, because a contact passes through lower
  // stiffnesses when it begins and ends.
  bool may_use = false;
  // Stiffness limit by the passivity conditions in haptics/analysis/passivity.h, valid for every passive hand. Empty
  // for the observer hold.
  std::optional<double> passive_limit;  // [N/m]
  std::optional<bool> passive;          // true if the wanted wall is passive
};

// Throws std::invalid_argument if a value is outside the range of the analysis.
StabilityAnswer answer(const StabilityQuestion& question);

// The largest stable stiffness as a function of the wall's damping (called Z-width in the literature).
struct StabilityMap {
  std::vector<double> damping;              // [N s/m] from 0 to beyond the largest value that is stable with every hand
  std::vector<std::vector<double>> limits;  // [N/m] exact limits: limits[hand][index of damping]
  std::vector<double> passive;              // [N/m] passivity limit for each damping
};

// `progress` is called with the completed fraction, 0 to 1.
StabilityMap stability_map(const StabilityQuestion& question, const std::function<void(double)>& progress);

}  // namespace gearshift::lab
