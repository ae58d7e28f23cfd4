// Runs many random contacts of one configuration with several hands, plant errors and jitter, and reports the worst
// results.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/base/chart.h"
#include "app/lab/contact/contact_rig.h"
#include "haptics/device/hand.h"

namespace gearshift::lab {

struct ContactHand {
  std::string name;
  haptics::HandImpedance hand;
};
std::vector<ContactHand> named_hands();  // those of haptics::kNamedHands and haptics::kElasticHands
// The hand with an elastic grip, whose three values are drawn: fingers of 5 to 50 g, 1000 to 8000 N/m, and a damping ratio
// of 0.1 to 0.8 for a handle of 0.1 kg. `drawn`: from 0 to 1.
haptics::HandImpedance with_grip(haptics::HandImpedance hand, const std::array<double, 3>& drawn);
// A rigid hand of 0.02 to 2.5 kg and 100 to 1500 N/m, with a damping ratio of 0.1 to 0.8. `drawn`: from 0 to 1.
haptics::HandImpedance any_hand(const std::array<double, 3>& drawn);
// Hands as above, which a seed determines. Every third is elastic.
std::vector<ContactHand> random_hands(int count, std::uint64_t seed);

struct Campaign {
  ContactCase contact;                     // base case; the values below and lever.hand and .seed replace its own
  double slowest = 0.1, fastest = 1.0;     // [m/s] impact speed
  double min_push = 4.0, max_push = 30.0;  // [N] push after the contact
  std::optional<double> place;             // [1] of the wall within an encoder count; empty: drawn
  double model_error = 0.05;               // [1]
  double period_jitter = 0.1;              // [1]
  int runs = 400;                          // per hand
  std::uint64_t seed = 7;
  std::vector<ContactHand> hands = named_hands();
};

struct HandOutcome {
  std::string hand;
  double ripple_p95 = 0.0;    // [m] 95th percentile of the peak-to-peak motion in the last 200 ms
  double ripple_max = 0.0;    // [m]
  double displayed = 1e9;     // [1] smallest ratio of displayed stiffness to commanded stiffness
  double peak = 0.0;          // [m] deepest penetration in all runs
  double force_step = 0.0;    // [N] largest change of the commanded force in one cycle
  double force_ripple = 0.0;  // [N] p95
  double tremble = 0.0;       // [m/s^2] p95 of the rms acceleration in the last 200 ms
  double softest = 1e9;       // [N/m] lowest wall stiffness at the end of a run
  int lowered = 0;            // largest number of stiffness reductions in one run
  int softened = 0;           // number of runs in which the reversal limiter softened the wall
  int saturated = 0;          // number of runs in which the motors were at their limit in the last 200 ms
  int stopped = 0;            // number of runs in which the guard switched the force off
};

// Runs the contacts of the hand with this index. Each hand has other contacts.
HandOutcome run_hand(const Campaign& campaign, std::size_t hand);
// Returns one outcome per hand.
std::vector<HandOutcome> run_campaign(const Campaign& campaign);

// Returns the outcome of the hand with the largest ripple.
const HandOutcome& worst_ripple(const std::vector<HandOutcome>& outcomes);
double deepest(const std::vector<HandOutcome>& outcomes);        // [m]
double min_displayed(const std::vector<HandOutcome>& outcomes);  // [1]
double softest(const std::vector<HandOutcome>& outcomes);        // [N/m]
// Fraction of all runs in which the wall was softened. `runs`: per hand. [1]
double softened_fraction(const std::vector<HandOutcome>& outcomes, int runs);

struct ImpactEnergy {
  double worst_fraction = -1e9;  // [1] largest ratio of the energy supplied by the wall to the impact energy
  double worst = -1e9;           // [J] largest energy supplied by the wall
  double mean_fraction = 0.0;    // [1]
  double restitution = 0.0;      // [1] largest
  double hardness = 1e9;         // [N/m] smallest rate-hardness at hardness_speed
  double hardness_speed = 0.0;   // [m/s] of the impacts the nearest to 0.3 m/s
  double surplus = -1e9;         // [J] largest energy supplied beyond what the handle dissipated
};

inline constexpr double kUsualSpeed = 0.3;  // [m/s]
struct ImpactPlan {
  std::vector<double> speeds{0.1, kUsualSpeed, 0.5, 1.0};  // [m/s]
  std::optional<double> place;                             // [1] as in Campaign
  std::uint64_t seed = 0;                                  // of the places
};

// Impacts of the handle on the wall without a hand, model error, jitter or other forces. `phases`: number of impacts at
// each speed.
ImpactEnergy run_impacts(ContactCase contact, int phases, const ImpactPlan& plan = {});

inline constexpr std::array kMotionBand{0.5, 0.7, 1.0, 1.4, 2.0, 3.0, 5.0, 7.0, 10.0, 14.0, 20.0};  // [Hz]
// Re Z over the stiffness K of the wall [N/m], and the damping Im Z / w, against frequency.
std::array<base::Curve, 2> curves_in_motion(const std::vector<DynamicStiffness>& found, double stiffness);

}  // namespace gearshift::lab
