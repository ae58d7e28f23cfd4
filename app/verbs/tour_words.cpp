#include "app/verbs/tour_words.h"

#include <fmt/core.h>

#include "app/limited_words.h"

namespace gearshift {

void print_tour(const TourSetup& setup, const TourResult& result) {
  for (const Limited& limited : result.limited) {
    fmt::print(stderr, "gearshift: {}\n", limited_words(limited));
  }
  fmt::print("{}: {:.2f} s at {:g} Hz\n", setup.layout.name, result.duration, setup.haptics.rate);
  for (const GearTime& gear : result.engaged)
    fmt::print("  {:>2} engaged at {:6.3f} s\n", gear_name(gear.gear), gear.time);
  if (result.softest < result.admitted) {
    fmt::print(stderr, "gearshift: the lever chattered on a wall: its stiffness was lowered from {:g} to {:g} N/m\n",
               result.admitted, result.softest);
  }
  fmt::print(
      "in contact {:.0f} % of the cycles, deepest {:.2f} mm beyond a wall, strongest push {:.1f} N, hash "
      "{:016x}\n",
      100.0 * result.contact_share(), 1e3 * result.deepest, result.strongest, result.hash);
}

}  // namespace gearshift
