// Impacts on a wall: energy supplied to the lever, and restitution.
#include <cmath>
#include <string>
#include <utility>

#include "app/lab/bench/lever/contact_campaign.h"
#include "app/lab/bench/rows/bench.h"

namespace gearshift::lab {
namespace {

// Impacts on a simple spring of 5000 N/m, with or without energy bounding. The row reports the energy that the motors
// supply beyond what the handle dissipates. The row without bounding is a negative control: its energy must be positive
// wherever the spring is not passive.
BenchRow spring_row(const std::string& timing, ContactCase contact, haptics::EnergyControl control, int phases) {
  contact.haptics.contact = {haptics::ContactHold::zero_order, control, false, true};
  contact.haptics.tuning.wall_damping = 0.0;
  contact.haptics.guard.slew = 100.0;
  const ImpactEnergy energy = run_impacts(contact, phases);
  const bool bounded = control == haptics::EnergyControl::energy_bounding;
  const std::string what = bounded ? "textbook spring of 5000 N/m with energy bounding" : "textbook spring of 5000 N/m";
  BenchRow row{"energy",
               what + ", energy added in excess of the damping, " + timing,
               1e3 * energy.surplus,
               "mJ",
               bounded ? std::optional(0.0) : std::nullopt,
               false,
               "worst contact",
               true,
               {{"mean fraction of the impact energy", 100.0 * energy.mean_fraction, "%"},
                {"maximum restitution", energy.restitution, ""}}};
  return bounded ? answers_design(Design::energy, std::move(row)) : row;
}

}  // namespace

std::vector<BenchRow> bench_energy(const BenchOptions& options) {
  const int phases = options.quick ? 10 : 400;
  std::vector<BenchRow> rows;
  for (const double rate : {2000.0, 1000.0, 500.0}) {
    if (options.progress) options.progress("energy", static_cast<double>(rows.size()) / 15.0);
    const std::string timing = std::to_string(static_cast<int>(rate)) + " Hz";
    ContactCase contact;
    contact.haptics.rate = rate;
    const ImpactEnergy shipped = run_impacts(contact, phases);
    rows.push_back(answers_design(
        Design::energy,
        {"energy",
         "energy added by the wall, worst impact, " + timing,
         1e3 * shipped.worst,
         "mJ",
         0.0,
         false,
         "no hand on the lever; impacts at 0.1 to 1 m/s, " + std::to_string(phases) + " sampling offsets per speed",
         true,
         {{"worst fraction of the impact energy", 100.0 * shipped.worst_fraction, "%"},
          {"maximum restitution", shipped.restitution, ""}}}));
    rows.push_back(spring_row(timing, contact, haptics::EnergyControl::none, phases));
    rows.push_back(spring_row(timing, contact, haptics::EnergyControl::energy_bounding, phases));
  }
  // With a delay or a low rate, the wall may add energy, so these rows have no goal.
  for (const auto& [rate, delay] :
       {std::pair{1000.0, 1}, {1000.0, 2}, {1000.0, 3}, {500.0, 1}, {200.0, 0}, {100.0, 0}}) {
    if (options.progress) options.progress("energy", static_cast<double>(rows.size()) / 15.0);
    ContactCase contact;
    contact.haptics.rate = rate;
    contact.lever.delay = delay;
    const ImpactEnergy energy = run_impacts(contact, options.quick ? 10 : 200);
    rows.push_back({"energy",
                    "energy added by the wall, worst impact, " + std::to_string(static_cast<int>(rate)) +
                        " Hz, delay " + std::to_string(delay),
                    1e3 * energy.worst,
                    "mJ",
                    {},
                    false,
                    "with the stiffness that the stability check allows",
                    true,
                    {{"worst fraction of the impact energy", 100.0 * energy.worst_fraction, "%"},
                     {"mean fraction of the impact energy", 100.0 * energy.mean_fraction, "%"}}});
  }
  return rows;
}

}  // namespace gearshift::lab
