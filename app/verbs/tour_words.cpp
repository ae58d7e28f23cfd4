#include "app/verbs/tour_words.h"

#include "app/limited_words.h"
#include "app/print_out.h"

namespace gearshift {

void print_tour(const TourSetup& setup, const TourResult& result) {
  for (const Limited& limited : result.limited) {
    print_problem("{}", limited_words(limited));
  }
  print_out("{}: {:.2f} s at {:g} Hz\n", setup.layout.name, result.duration, setup.haptics.rate);
  for (const GearTime& gear : result.engaged)
    print_out("  {:>2} engaged at {:6.3f} s\n", gear_name(gear.gear), gear.time);
  if (result.softest < result.admitted) {
    print_problem("the lever chattered on a wall: its stiffness was lowered from {:g} to {:g} N/m", result.admitted,
                  result.softest);
  }
  if (result.lost.times > 0) {
    print_problem("its forces were gone {}, first after {:.3f} s: {}",
                  result.lost.times == 1 ? "once" : fmt::format("{} times", result.lost.times), result.lost.time,
                  guard_fault_name(result.lost.fault));
  }
  print_out(
      "in contact {:.0f} % of the cycles, deepest {:.2f} mm beyond a wall, strongest push {:.1f} N, hash "
      "{:016x}\n",
      100.0 * result.contact_share(), 1e3 * result.deepest, result.strongest, result.hash);
}

}  // namespace gearshift
