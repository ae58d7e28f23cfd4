#include "app/verbs/print_tour.h"

#include "app/base/console.h"
#include "haptics/loop/haptic_config.h"

namespace gearshift::verbs {

void print_tour(const lab::TourSetup& setup, const lab::TourResult& result) {
  for (const haptics::TuningLimit& limited : result.limits) {
    base::print_message("{}", haptics::describe(limited));
  }
  base::print_out("{}: {:.2f} s at {:g} Hz\n", setup.layout.name, result.duration, setup.haptics.rate);
  for (const lab::GearTime& gear : result.engaged)
    base::print_out("  {:>2} engaged at {:6.3f} s\n", haptics::gear_label(setup.gate, gear.gear), gear.time);
  if (result.softest < result.admitted) {
    base::print_message("the lever chattered on a wall, so the wall was softened from {:g} to {:g} N/m",
                        result.admitted, result.softest);
  }
  if (result.lost.times > 0) {
    base::print_message("the force guard switched the forces off {}, first after {:.3f} s; fault: {}",
                        result.lost.times == 1 ? "once" : fmt::format("{} times", result.lost.times), result.lost.time,
                        haptics::to_string(result.lost.fault));
  }
  base::print_out(
      "in contact with a wall in {:.0f} % of the cycles, at most {:.2f} mm beyond a wall; strongest push: {:.1f} N; "
      "hash {:016x}\n",
      100.0 * result.contact_fraction(), 1e3 * result.deepest, result.strongest, result.hash);
}

}  // namespace gearshift::verbs
