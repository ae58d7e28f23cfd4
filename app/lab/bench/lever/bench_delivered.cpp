// Force at the tip against a steady push into the wall, from 6 N to the motors' limit.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/contact/contact_rig.h"

namespace gearshift::lab {
namespace {

constexpr double kWallAt = 0.005;  // [m] position of the wall; at 0 the handle's spring is relaxed

// Computed force of an ideal spring of the wanted stiffness, in balance with the push, the handle's spring and the
// hand's spring. [N]
double balance_force(const ContactCase& contact) {
  const double wall = contact.haptics.tuning.wall_stiffness, spring = contact.lever.axis_x.stiffness;
  return wall * (contact.push - spring * kWallAt) / (wall + spring + contact.lever.hand.stiffness);
}

}  // namespace

std::vector<BenchRow> bench_delivered(const BenchOptions& options) {
  double worst = 0.0, ripple = 0.0, worst_push = 0.0;
  const int steps = options.quick ? 6 : 26;
  for (const haptics::NamedHand& named : haptics::kNamedHands) {
    for (int i = 0; i < steps; ++i) {
      if (options.progress) options.progress("delivered", static_cast<double>(i) / steps);
      ContactCase contact;
      contact.lever.hand = named.hand;
      contact.push = 6.0 + 25.0 * i / (steps - 1);
      contact.duration = 1.5;
      const ContactResult one = run_contact(contact);
      const double error = std::abs(one.delivered / balance_force(contact) - 1.0);
      if (error > worst) worst_push = contact.push;
      worst = std::max(worst, error);
      ripple = std::max(ripple, one.force_ripple);
    }
  }
  return {
      answers_design(Design::delivered, {"delivered",
                                         "tip force against a steady push of 6 to 31 N, mean over 50 ms",
                                         100.0 * worst,
                                         "%",
                                         3.0,
                                         false,
                                         "deviation from a 5000 N/m spring in equilibrium with push, handle and hand; "
                                         "worst of all hands; the just noticeable difference of gear forces is 3.2 %",
                                         true,
                                         {{"worst at a push of", worst_push, "N"}}}),
      {"delivered",
       "ripple of the tip force, peak-to-peak",
       ripple,
       "N",
       {},
       false,
       "mostly the wall damping times one encoder count per period"}};
}

}  // namespace gearshift::lab
