#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/base/colours.h"
#include "app/lab/reproduce/section.h"
#include "app/lab/reproduce/study_files.h"
#include "app/lab/reproduce/trial.h"
#include "haptics/contact/virtual_coupling.h"

namespace gearshift::lab {
namespace {

// The paper's Fig. 6 (b): at 200 Hz, the lever enters the wall at 188 ms and leaves it at 213 ms.
constexpr double kPeriod = 1.0 / 200.0;             // [s]
constexpr double kEnters = 0.188, kLeaves = 0.213;  // [s]
constexpr double kEntrySpeed = 0.3;                 // [m/s] not in the paper; does not affect the percentages
constexpr int kFirst = 36, kLast = 44;              // [samples] 180 to 220 ms

// Depth of the lever at `time` [m]: a parabola through entry and exit, as if a constant force threw the lever back.
double depth(double time) {
  const double half = 0.5 * (kLeaves - kEnters), middle = 0.5 * (kLeaves + kEnters);
  const double u = (time - middle) / half;
  return 0.5 * kEntrySpeed * half * (1.0 - u * u);
}
double sampled_depth(int sample) {
  return depth(sample * kPeriod);
}

// Energy stored in a spring at depth `at`. [J]
double stored(double stiffness, double at) {
  return 0.5 * stiffness * std::max(0.0, at) * std::max(0.0, at);
}

// Force of the trainer's own coupling, without damping, in the period that begins at a sample. Positive: out of the
// wall. [N]
double coupled_force(const haptics::Coupling& coupling, int sample) {
  static const haptics::Gate gate = wall_at_zero();
  const haptics::Passage passage = haptics::open_passage(gate);
  haptics::LeverMotion motion;
  motion.position = {sampled_depth(sample), 0.0};
  motion.velocity = {(sampled_depth(sample) - sampled_depth(sample - 1)) / coupling.period, 0.0};
  return -haptics::contact_force(coupling, gate, passage, haptics::place_proxy(gate, motion.position), motion).force.x;
}

// Force [N] of the observer hold if the observer predicts the position at the end of the period exactly. The lever's
// path is prescribed, so the force does not change it.
double observed_force(const haptics::Coupling& coupling, int sample) {
  constexpr double kRigid = 1e-9;  // [m/N] practically rigid
  return haptics::solved_force(coupling, sampled_depth(sample), sampled_depth(sample + 1), kRigid);
}

struct Hold {
  const char* name;
  const char* tag;
  std::array<double, kLast> force{};  // [N] by sample
  double first = 0.0, second = 0.0;   // [J] energy generated in regions I and II (see regions())
  double total = 0.0;                 // [J] energy generated over the complete contact
};

// Sums the energy that the held force supplies to the lever beyond what an ideal spring would supply.
void sum_energy(Hold& hold, double stiffness) {
  for (int i = kFirst; i < kLast; ++i) {
    const double begin = sampled_depth(i), end = sampled_depth(i + 1);
    const double work = hold.force[static_cast<std::size_t>(i)] * (begin - end);
    const double surplus = work - (stored(stiffness, begin) - stored(stiffness, end));
    if (begin <= 0.0 && end > 0.0) hold.first += surplus;
    if (begin > 0.0 && end <= 0.0) hold.second += surplus;
    hold.total += surplus;
  }
}

std::array<Hold, 3> make_holds(double stiffness) {
  std::array<Hold, 3> holds{Hold{"zero-order hold, as in the paper", "zero_order"},
                            Hold{"half-sample hold, the shipped default", "half_sample"},
                            Hold{"ideal hold, which knows the next position", "observed"}};
  haptics::Coupling coupling{stiffness, 0.0, kPeriod, 0, haptics::ContactHold::zero_order};
  for (int i = kFirst; i < kLast; ++i) {
    const auto sample = static_cast<std::size_t>(i);
    coupling.hold = haptics::ContactHold::zero_order;
    holds[0].force[sample] = coupled_force(coupling, i);
    coupling.hold = haptics::ContactHold::half_sample;
    holds[1].force[sample] = coupled_force(coupling, i);
    holds[2].force[sample] = observed_force(coupling, i);
  }
  for (Hold& hold : holds) sum_energy(hold, stiffness);
  return holds;
}

// Writes the position and, for each hold, the force divided by the wall's stiffness g, as in the paper's figure. Both
// quantities are lengths and share one scale.
void write_curves(const Study& study, const std::array<Hold, 3>& holds, double stiffness) {
  constexpr int kFine = 50;  // points per sampling period
  CsvFile csv(study, "deferred_force",
              "time_ms,depth_mm,zero_order_force_over_g_mm,half_sample_force_over_g_mm,observed_force_over_g_mm");
  for (int i = kFirst * kFine; i < kLast * kFine; ++i) {
    const double time = kPeriod * i / kFine;
    const auto sample = static_cast<std::size_t>(i / kFine);
    const auto over_g = [&](const Hold& hold) { return 1e3 * hold.force[sample] / stiffness; };
    csv.row({1e3 * time, 1e3 * depth(time), over_g(holds[0]), over_g(holds[1]), over_g(holds[2])});
  }
  csv.finish();
}

// gnuplot commands for the paper's regions I and II. Each region lasts from a wall crossing to the next sample, which
// detects the crossing.
std::string regions(const char* force) {
  const double entry_detected = std::ceil(kEnters / kPeriod) * kPeriod,
               exit_detected = std::ceil(kLeaves / kPeriod) * kPeriod;
  return fmt::format(
      R"gp("" using ($1>={0}&&$1<={1}?$1:1/0):(column("depth_mm")):(column("{4}")) \
    with filledcurves fillcolor "{5}" fillstyle solid 0.45 title "region I", \
  "" using ($1>={2}&&$1<={3}?$1:1/0):(column("depth_mm")):(column("{4}")) \
    with filledcurves fillcolor "{6}" fillstyle solid 0.45 title "region II", \
)gp",
      1e3 * kEnters, 1e3 * entry_detected, 1e3 * kLeaves, 1e3 * exit_detected, force, base::kBufferColour,
      base::kLockoutColour);
}

std::string panel(const Hold& hold) {
  const std::string force = fmt::format("{}_force_over_g_mm", hold.tag);
  return fmt::format(R"gp(set title "{}"
plot "deferred_force.csv" using 1:(0) with lines linecolor "{}" notitle, \
  {}  "" using "time_ms":"depth_mm" with lines linewidth 1.5 linecolor "{}" title "position", \
  "" using "time_ms":"{}" with lines linewidth 1.8 linecolor "{}" title "force / g"
)gp",
                     hold.name, base::kSoftInk, regions(force.c_str()), base::kLockoutColour, force, base::kGearColour);
}

void draw_curves(const Study& study, const std::array<Hold, 3>& holds) {
  draw(study, {"deferred_force", 1200, 460,
               fmt::format("set multiplot layout 1,3 margins 0.05, 0.975, 0.13, 0.92 spacing 0.06\n"
                           "set key bottom center\nset xlabel \"time [ms]\"\nset xtics 10\nset mxtics 2\n"
                           "set yrange [-2.6:2.4]\nset ylabel \"position, force / g [mm]\"\n{}{}{}unset multiplot\n",
                           panel(holds[0]), panel(holds[1]), panel(holds[2]))});
}

std::string energy(double joule, double peak_energy) {
  return fmt::format("{:+.3g} mJ ({:+.3g} %)", 1e3 * joule, 100.0 * joule / peak_energy);
}

std::string energies(const Hold& hold, double peak_energy) {
  return fmt::format("region I {}, region II {}, whole contact {}", energy(hold.first, peak_energy),
                     energy(hold.second, peak_energy), energy(hold.total, peak_energy));
}

// [ms] Times at which the first period with a force begins and the last one ends.
std::array<double, 2> force_times(const Hold& hold) {
  int first = kLast, last = kFirst;
  for (int i = kFirst; i < kLast; ++i) {
    if (hold.force[static_cast<std::size_t>(i)] <= 0.0) continue;
    first = std::min(first, i);
    last = i + 1;
  }
  return {1e3 * kPeriod * first, 1e3 * kPeriod * last};
}

}  // namespace

Section deferred_force_section(const Study& study) {
  const double stiffness = study.preset.haptics.tuning.wall_stiffness;
  const std::array<Hold, 3> holds = make_holds(stiffness);
  const double peak_energy = stored(stiffness, depth(0.5 * (kEnters + kLeaves)));
  write_curves(study, holds, stiffness);
  draw_curves(study, holds);

  const auto [begins, ends] = force_times(holds[0]);
  Section section{"deferred_force", "Fig. 6 (b): deferred force generation", "", {}, {}};
  section.text = fmt::format(
      "A prescribed path enters the wall at {:g} ms and leaves it at {:g} ms, sampled at {:g} Hz; the entry speed is "
      "{:g} m/s. The wall force is computed from these samples as in the trainer, for a spring of {:g} N/m without "
      "damping. The third hold is an ideal one, which knows where the lever will be when the hold ends, like an "
      "observer with a perfect model. The energy is what the held force adds to the lever compared with an ideal "
      "spring, during "
      "the hold in which the lever enters the wall (region I) and the one in which it leaves the wall (region II). "
      "Percentages refer to the {:.3g} mJ stored at the deepest point.",
      1e3 * kEnters, 1e3 * kLeaves, 1.0 / kPeriod, kEntrySpeed, stiffness, 1e3 * peak_energy);
  section.findings = {{"Fig. 6 (b): the lever enters at 188 ms, but \"the simulated reflective force was computed "
                       "until 190 ms\"; it leaves at 213 ms, but the force lasts until 215 ms",
                       fmt::format("zero-order hold: force from {:g} to {:g} ms", begins, ends),
                       fmt::format("{:+.2g} and {:+.2g} ms", begins - 190.0, ends - 215.0)},
                      {"Section 3.1: \"late energy generation\" in regions I and II",
                       "zero-order hold: " + energies(holds[0], peak_energy), "the paper gives no numbers"},
                      {"Section 3.1: the cure is \"a sampling rate up to 1 K Hz\" or a slow joystick",
                       "half-sample hold, also at 200 Hz: " + energies(holds[1], peak_energy) +
                           "; ideal hold: " + energies(holds[2], peak_energy),
                       fmt::format("{:+.0f} % and {:+.0f} % of the zero-order hold's energy",
                                   100.0 * holds[1].total / holds[0].total, 100.0 * holds[2].total / holds[0].total)}};
  section.pictures = {
      {"deferred_force",
       "Position and held force on one scale. Region I: the lever is inside the wall without a force; region II: it is "
       "outside the wall with a force. The half-sample hold starts before the wall is reached, because it extrapolates "
       "the motion."}};
  return section;
}

}  // namespace gearshift::lab
