// Impacts on a wall: energy supplied to the lever, and restitution.
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "app/lab/bench/rows/bench.h"
#include "app/lab/contact/contact_campaign.h"

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

// The wall with the stiffness that the stability check allows. The energy is counted from the first force to the last,
// so restitution squared, less one, bounds it from below.
BenchRow shipped_row(const std::string& timing, const ImpactEnergy& energy, int phases) {
  return answers_design(Design::energy, {"energy",
                                         "energy added by the wall, worst impact, " + timing,
                                         1e3 * energy.worst,
                                         "mJ",
                                         0.0,
                                         false,
                                         "no hand on the lever; impacts at 0.1 to 1 m/s, " + std::to_string(phases) +
                                             " sampling offsets per speed",
                                         true,
                                         {{"worst fraction of the impact energy", 100.0 * energy.worst_fraction, "%"},
                                          {"mean fraction of the impact energy", 100.0 * energy.mean_fraction, "%"},
                                          {"maximum restitution", energy.restitution, ""},
                                          {"least rate-hardness at 0.3 m/s", 1e-3 * energy.hardness, "kN/m"}}});
}

// Rate-hardness with a pulse on each entry, which the program does not use: app/lab/contact/README.md says why.
BenchRow pulse_row(const std::string& timing, const ContactCase& contact, const BenchOptions& options) {
  constexpr double kDecay = 0.006;  // [s] shorter pulses add energy at more delays
  const int phases = options.quick ? 10 : 100;
  const auto ripple = [&](const ContactCase& with) {
    Campaign campaign;
    campaign.contact = with;
    campaign.runs = options.quick ? 4 : 60;
    return 1e3 * worst_ripple(run_campaign(campaign)).ripple_p95;
  };
  ContactCase pulsed = contact;
  pulsed.pulse = kDecay;
  const ImpactEnergy without = run_impacts(contact, phases), with = run_impacts(pulsed, phases);
  return {"energy",
          "least rate-hardness at 0.3 m/s with a pulse on entry, " + timing,
          1e-3 * with.hardness,
          "kN/m",
          std::nullopt,
          false,
          "not used by the program",
          true,
          {{"without", 1e-3 * without.hardness, "kN/m"},
           {"worst fraction of the impact energy", 100.0 * with.worst_fraction, "%"},
           {"without", 100.0 * without.worst_fraction, "%"},
           {"motion of the pressed lever, worst hand", ripple(pulsed), "mm"},
           {"without", ripple(contact), "mm"}}};
}

}  // namespace

std::vector<BenchRow> bench_energy(const BenchOptions& options) {
  const int phases = options.quick ? 10 : 400;
  std::vector<BenchRow> rows;
  const std::pair<double, int> timings[] = {{2000.0, 0}, {1000.0, 0}, {500.0, 0},  {1000.0, 1}, {1000.0, 2},
                                            {1000.0, 3}, {1000.0, 4}, {1000.0, 8}, {500.0, 1},  {500.0, 2},
                                            {250.0, 0},  {200.0, 0},  {100.0, 0}};
  constexpr double kRows = 38.0;
  for (const auto& [rate, delay] : timings) {
    if (options.progress) options.progress("energy", static_cast<double>(rows.size()) / kRows);
    const std::string timing =
        std::to_string(static_cast<int>(rate)) + " Hz" + (delay == 0 ? "" : ", delay " + std::to_string(delay));
    ContactCase contact;
    contact.haptics.rate = rate;
    contact.lever.delay = delay;
    rows.push_back(shipped_row(timing, run_impacts(contact, phases), phases));
    rows.push_back(pulse_row(timing, contact, options));
    if (delay > 0 || rate < 500.0) continue;
    rows.push_back(spring_row(timing, contact, haptics::EnergyControl::none, phases));
    rows.push_back(spring_row(timing, contact, haptics::EnergyControl::energy_bounding, phases));
  }
  // Walls that the device's springs render wholly or nearly, so that the loop's part is small and late.
  for (const auto& [delay, springs, wanted] : {std::tuple{3, 3000.0, 3000.0},
                                               {3, 3000.0, 3200.0},
                                               {5, 3000.0, 3000.0},
                                               {5, 3000.0, 3200.0},
                                               {8, 1000.0, 1000.0},
                                               {8, 5000.0, 5800.0}}) {
    ContactCase contact;
    contact.lever.delay = delay;
    contact.lever.device_wall_stiffness = springs;
    contact.haptics.tuning.wall_stiffness = wanted;
    rows.push_back(shipped_row(
        fmt::format("1000 Hz, delay {}, wall of {:g} N/m on device walls of {:g} N/m", delay, wanted, springs),
        run_impacts(contact, phases), phases));
  }
  return rows;
}

}  // namespace gearshift::lab
