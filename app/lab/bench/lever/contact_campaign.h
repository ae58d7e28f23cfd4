// Runs many random contacts of one configuration with every hand, plant errors and jitter, and reports the worst.
#pragma once

#include <string>
#include <vector>

#include "app/lab/bench/lever/contact_rig.h"
#include "haptics/device/hand.h"

namespace gearshift::lab {

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
  double displayed = 0.0;     // [1] smallest ratio of displayed to used stiffness
  double peak = 0.0;          // [m] deepest of all
  double force_step = 0.0;    // [N] largest change of the command in a cycle
  double force_ripple = 0.0;  // [N] p95
  double softest = 0.0;       // [N/m] smallest stiffness in use at the end of a run
  int lowered = 0;            // largest number of softenings in one run
  int stopped = 0;            // runs in which the guard switched the force off
};

// One outcome per listed hand.
std::vector<HandOutcome> run_campaign(const Campaign& campaign);

// The outcome of the hand with the largest ripple.
const HandOutcome& worst_ripple(const std::vector<HandOutcome>& outcomes);
double deepest(const std::vector<HandOutcome>& outcomes);          // [m]
double least_displayed(const std::vector<HandOutcome>& outcomes);  // [1]

struct ImpactEnergy {
  double worst_share = -1e9;  // [1] largest energy given by the wall over the energy of the impact
  double worst = -1e9;        // [J] largest energy given by the wall
  double mean_share = 0.0;    // [1]
  double restitution = 0.0;   // [1] largest
  double surplus = -1e9;      // [J] largest energy beyond the dissipation of the handle
};

// Free impacts of the bare, nominal handle at 0.1, 0.3, 0.5 and 1 m/s, `phases` of each; only the wall acts.
ImpactEnergy run_impacts(ContactCase contact, int phases);

}  // namespace gearshift::lab
