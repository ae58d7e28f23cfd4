// What a wall makes of an impact: energy given to the lever, restitution.
#include <cmath>
#include <string>

#include "tests/bench/bench.h"
#include "tests/bench/contact_campaign.h"

namespace gearshift {

std::vector<BenchRow> bench_energy(const BenchOptions& options) {
  const int phases = options.quick ? 40 : 400;
  std::vector<BenchRow> rows;
  for (const double rate : {2000.0, 1000.0, 500.0}) {
    if (options.progress) options.progress("energy", static_cast<double>(rows.size()) / 9.0);
    const std::string at = std::to_string(static_cast<int>(rate)) + " Hz";
    ContactCase contact;
    contact.haptics.rate = rate;
    const ImpactEnergy shipped = run_impacts(contact, phases);
    rows.push_back({"energy",
                    "made by the wall, worst impact, " + at,
                    1e3 * shipped.worst,
                    "mJ",
                    0.0,
                    false,
                    "bare handle, 0.1 to 1 m/s, " + std::to_string(phases) + " phases each",
                    true,
                    {{"worst share of the impact", 100.0 * shipped.worst_share, "%"},
                     {"restitution at most", shipped.restitution, ""}}});
    contact.haptics.contact.energy_control = EnergyControl::energy_bounding;
    const ImpactEnergy bounded = run_impacts(contact, phases);
    rows.push_back({"energy",
                    "with energy bounding, beyond what the damping took, " + at,
                    1e3 * bounded.surplus,
                    "mJ",
                    0.0,
                    false,
                    "worst contact",
                    true,
                    {{"restitution at most", bounded.restitution, ""}}});
    contact.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
    contact.haptics.tuning.wall_damping = 0.0;
    contact.haptics.guard.slew = 100.0;
    const ImpactEnergy spring = run_impacts(contact, phases);
    rows.push_back({"energy",
                    "a textbook spring of 5000 N/m, for comparison, " + at,
                    1e3 * spring.worst,
                    "mJ",
                    {},
                    false,
                    "study",
                    true,
                    {{"mean share of the impact", 100.0 * spring.mean_share, "%"},
                     {"restitution at most", spring.restitution, ""}}});
  }
  return rows;
}

}  // namespace gearshift
