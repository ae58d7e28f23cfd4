// "May I use K, B at T on this device?", and for which K and B the answer is yes.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "haptics/analysis/sampled_loop.h"

namespace gearshift {

struct JudgedHand {
  std::string name;
  HandImpedance hand;
};

struct StabilityQuestion {
  std::string device;  // its name, for people
  AxisModel handle;
  double rate = 1000.0;           // [Hz]
  ContactLaw wall;                // wanted
  std::vector<JudgedHand> hands;  // at least one

  double period() const { return 1.0 / rate; }  // [s]
};

struct HandVerdict {
  double limit = 0.0;   // [N/m] exact, 0 to infinite
  double radius = 0.0;  // [1] spectral radius with the wanted wall
};

struct StabilityAnswer {
  std::vector<HandVerdict> hands;  // one for each that was asked about
  std::size_t deciding = 0;        // the hand with the lowest limit
  double limit = 0.0;              // [N/m] its limit
  double radius = 0.0;             // [1] the largest
  bool stable = false;             // the wanted wall, in each of these hands
  // Stable, and so is every softer one: a contact that begins or ends passes through them.
  bool may_use = false;
  // What the paper's conditions say of every passive hand. Nothing for the observed hold: see passivity.h.
  std::optional<double> passive_limit;  // [N/m]
  std::optional<bool> passive;          // the wanted wall
};

// Throws std::invalid_argument where the analysis does.
StabilityAnswer answer(const StabilityQuestion& question);

// The largest stiffness over the wall's damping: what the literature calls the Z-width.
struct StabilityMap {
  std::vector<double> damping;              // [N s/m] from 0 to beyond the last that is of use in every hand
  std::vector<std::vector<double>> limits;  // [N/m] exact, for each hand, over damping
  std::vector<double> passive;              // [N/m] over damping
};

// progress: told the share that is done, 0 to 1.
StabilityMap stability_map(const StabilityQuestion& question, const std::function<void(double)>& progress);

}  // namespace gearshift
