// Many contacts of one configuration, and the worst of them: seeded, every hand, plant error, jitter.
#pragma once

#include <string>
#include <vector>

#include "haptics/device/hand.h"
#include "tests/bench/contact_rig.h"

namespace gearshift {

struct Campaign {
  ContactCase contact;         // speed, phase, hand and seed are drawn
  double slowest = 0.1;        // [m/s] of the impacts
  double fastest = 1.0;        // [m/s]
  double model_error = 0.05;   // [1]
  double period_jitter = 0.1;  // [1]
  int runs = 400;              // per hand
};

struct HandOutcome {
  std::string hand;
  double ripple_p95 = 0.0;    // [m] of the last 200 ms
  double ripple_most = 0.0;   // [m]
  double displayed = 0.0;     // [1] least of displayed over used stiffness
  double peak = 0.0;          // [m] deepest of all
  double force_step = 0.0;    // [N] largest change of the command in a cycle
  double force_ripple = 0.0;  // [N] p95
  double softest = 0.0;       // [N/m] stiffness in use at the end, the least
  int lowered = 0;            // most times in one run
  int stopped = 0;            // runs in which the guard took the force
};

// One outcome per listed hand.
std::vector<HandOutcome> run_campaign(const Campaign& campaign);

// Of the hand that fares worst.
const HandOutcome& worst_ripple(const std::vector<HandOutcome>& outcomes);
double deepest(const std::vector<HandOutcome>& outcomes);          // [m]
double least_displayed(const std::vector<HandOutcome>& outcomes);  // [1]

struct ImpactEnergy {
  double worst_share = -1e9;  // [1] given by the wall over the impact's, the largest
  double worst = -1e9;        // [J] the same, absolute
  double mean_share = 0.0;    // [1]
  double restitution = 0.0;   // [1] largest
  double surplus = -1e9;      // [J] given beyond what the handle's damping took, the largest
};

// Free impacts of the bare, nominal handle at 0.1, 0.3, 0.5 and 1 m/s, `phases` of each; nothing but the wall acts.
ImpactEnergy run_impacts(ContactCase contact, int phases);

}  // namespace gearshift
