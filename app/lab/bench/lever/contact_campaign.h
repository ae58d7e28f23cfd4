// Runs many random contacts of one configuration with all named hands, plant errors and jitter, and reports the worst
// results.
#pragma once

#include <string>
#include <vector>

#include "app/lab/bench/lever/contact_rig.h"
#include "haptics/device/hand.h"

namespace gearshift::lab {

struct Campaign {
  ContactCase contact;         // base case; speed, phase, hand and seed are replaced by random values
  double slowest = 0.1;        // [m/s] slowest impact
  double fastest = 1.0;        // [m/s]
  double model_error = 0.05;   // [1]
  double period_jitter = 0.1;  // [1]
  int runs = 400;              // per hand
};

struct HandOutcome {
  std::string hand;
  double ripple_p95 = 0.0;    // [m] 95th percentile of the peak-to-peak motion in the last 200 ms
  double ripple_max = 0.0;    // [m]
  double displayed = 0.0;     // [1] smallest ratio of displayed stiffness to commanded stiffness
  double peak = 0.0;          // [m] deepest penetration in all runs
  double force_step = 0.0;    // [N] largest change of the commanded force in one cycle
  double force_ripple = 0.0;  // [N] p95
  double softest = 0.0;       // [N/m] lowest wall stiffness at the end of a run
  int lowered = 0;            // largest number of stiffness reductions in one run
  int stopped = 0;            // number of runs in which the guard switched the force off
};

// Returns one outcome per named hand (kNamedHands).
std::vector<HandOutcome> run_campaign(const Campaign& campaign);

// Returns the outcome of the hand with the largest ripple.
const HandOutcome& worst_ripple(const std::vector<HandOutcome>& outcomes);
double deepest(const std::vector<HandOutcome>& outcomes);        // [m]
double min_displayed(const std::vector<HandOutcome>& outcomes);  // [1]

struct ImpactEnergy {
  double worst_fraction = -1e9;  // [1] largest ratio of the energy supplied by the wall to the impact energy
  double worst = -1e9;           // [J] largest energy supplied by the wall
  double mean_fraction = 0.0;    // [1]
  double restitution = 0.0;      // [1] largest
  double surplus = -1e9;         // [J] largest energy supplied beyond what the handle dissipated
};

// Impacts of the handle on the wall without a hand, plant errors or other forces. `phases`: number of impacts at each
// of the speeds 0.1, 0.3, 0.5 and 1 m/s.
ImpactEnergy run_impacts(ContactCase contact, int phases);

}  // namespace gearshift::lab
