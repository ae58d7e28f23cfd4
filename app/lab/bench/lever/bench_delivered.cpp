// Force at the tip against a steady push into the wall, from 6 N to the motors' limit.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/lab/bench/lever/contact_rig.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

constexpr double kWallAt = 0.005;  // [m] from the centre, where the handle's spring is relaxed, to the rig's wall

// Force of an ideal spring of the wanted stiffness in balance with the push, the handle's spring and the hand's spring;
// computed, not measured. [N]
double at_rest(const ContactCase& contact) {
  const double wall = contact.haptics.tuning.wall_stiffness, own = contact.lever.axis_x.stiffness;
  return wall * (contact.push - own * kWallAt) / (wall + own + contact.lever.hand.stiffness);
}

}  // namespace

std::vector<BenchRow> bench_delivered(const BenchOptions& options) {
  double worst = 0.0, ripple = 0.0, at = 0.0;
  const int steps = options.quick ? 6 : 26;
  for (const haptics::NamedHand& named : haptics::kNamedHands) {
    for (int i = 0; i < steps; ++i) {
      if (options.progress) options.progress("delivered", static_cast<double>(i) / steps);
      ContactCase contact;
      contact.lever.hand = named.hand;
      contact.push = 6.0 + 25.0 * i / (steps - 1);
      contact.duration = 1.5;
      const ContactResult one = run_contact(contact);
      const double error = std::abs(one.delivered / at_rest(contact) - 1.0);
      if (error > worst) at = contact.push;
      worst = std::max(worst, error);
      ripple = std::max(ripple, one.force_ripple);
    }
  }
  return {answers_design(Design::delivered,
                         {"delivered",
                          "tip force against a steady push of 6 to 31 N, mean over 50 ms",
                          100.0 * worst,
                          "%",
                          3.0,
                          false,
                          "of what a spring of 5000 N/m gives in balance with push, handle and hand, worst of "
                          "every hand; the just noticeable difference for gear forces is 3.2 %",
                          true,
                          {{"at a push of", at, "N"}}}),
          {"delivered",
           "its ripple, peak-to-peak",
           ripple,
           "N",
           {},
           false,
           "mostly B times the encoder's count per period"}};
}

}  // namespace gearshift::lab
